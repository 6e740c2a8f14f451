# "cmake --install" and, by CPack, a Debian package and an archive. Included by CMakeLists.txt.
# The parts are those of Debian's packages: tyndall, libtyndall0, libtyndall-dev, python3-tyndall.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME tyndall)
# "./run" builds the program alone: without the libraries it is installed all the same.
foreach(target IN ITEMS tyndall_library tyndall_watch tyndall_python)
  if(TARGET ${target})
    install(CODE "if(NOT EXISTS \"$<TARGET_FILE:${target}>\")
      message(NOTICE \"not built, so not installed: $<TARGET_FILE_NAME:${target}> (cmake --build ${PROJECT_BINARY_DIR} --target ${target})\")
    endif()" ALL_COMPONENTS)
  endif()
endforeach()
install(TARGETS tyndall RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES assets/scene.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/tyndall)
install(DIRECTORY assets/scenes assets/templates assets/textures assets/verify DESTINATION ${CMAKE_INSTALL_DATADIR}/tyndall
        FILES_MATCHING REGEX "\\.(json|csv|html|py|png|jpg)$")
install(DIRECTORY app/book/tyndall/book DESTINATION lib/tyndall)
install(TARGETS tyndall_book LIBRARY DESTINATION lib/tyndall/book)
install(PROGRAMS assets/farm/slurm.sh assets/farm/parallel.sh DESTINATION ${CMAKE_INSTALL_DATADIR}/tyndall/farm)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES app/README.md app/FARMS.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(page IN ITEMS book cli watch window)
  install(FILES app/${page}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/${page})
endforeach()
install(FILES assets/desktop/tyndall.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES assets/desktop/tyndall.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES assets/desktop/tyndall.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)

# The libraries for programs of others, for CMake's find_package(tyndall) and for pkg-config.
include(CMakePackageConfigHelpers)
set(package ${PROJECT_BINARY_DIR}/package)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tyndall)
install(TARGETS tyndall_library EXPORT tyndallTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libtyndall NAMELINK_COMPONENT libtyndall-dev OPTIONAL)
# The window belongs to the program's package: programs without one need no libraries of a display.
install(TARGETS tyndall_watch EXPORT tyndallTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT tyndall NAMELINK_COMPONENT libtyndall-dev OPTIONAL)
install(DIRECTORY core/api/tyndall app/watch/tyndall DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libtyndall-dev
        FILES_MATCHING PATTERN "*.h")
install(EXPORT tyndallTargets NAMESPACE tyndall:: DESTINATION ${package_folder} COMPONENT libtyndall-dev)
file(CONFIGURE OUTPUT ${package}/tyndallConfig.cmake
     CONTENT "include(\"\${CMAKE_CURRENT_LIST_DIR}/tyndallTargets.cmake\")\n" @ONLY)
write_basic_package_version_file(${package}/tyndallConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${package}/tyndallConfig.cmake ${package}/tyndallConfigVersion.cmake DESTINATION ${package_folder}
        COMPONENT libtyndall-dev)
# The prefix is found from the place of the file, so that an installed tree may be moved.
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
function(tyndall_pkg_config name description)
  file(CONFIGURE OUTPUT ${package}/${name}.pc @ONLY CONTENT [[
prefix=${pcfiledir}/@to_prefix@
Name: @name@
Description: @description@
Version: @PROJECT_VERSION@
Cflags: -I${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
Libs: -L${prefix}/@CMAKE_INSTALL_LIBDIR@ -l@name@
]])
  install(FILES ${package}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT libtyndall-dev)
endfunction()
tyndall_pkg_config(tyndall "Tyndall's scenes, renders and comparisons")
tyndall_pkg_config(tyndall-watch "Tyndall's window over samples that a program computes")
install(DIRECTORY assets/examples/cmake assets/examples/watch DESTINATION ${CMAKE_INSTALL_DATADIR}/tyndall/examples
        COMPONENT libtyndall-dev)
if(TARGET tyndall_python)
  install(DIRECTORY assets/examples/pytest assets/notebooks DESTINATION ${CMAKE_INSTALL_DATADIR}/tyndall/examples
          COMPONENT python3-tyndall PATTERN __pycache__ EXCLUDE PATTERN baselines EXCLUDE)
endif()

# The manual's page and the completion of shells are printed by the program itself, while it is installed.
set(manual ${PROJECT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual})
function(tyndall_printed form file folder)
  install(CODE "execute_process(COMMAND ${CMAKE_CROSSCOMPILING_EMULATOR} \"$<TARGET_FILE:tyndall>\" help ${form}
                                OUTPUT_FILE \"${manual}/${file}\" COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${manual}/${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder})
endfunction()
tyndall_printed(bash tyndall bash-completion/completions)
tyndall_printed(zsh _tyndall zsh/site-functions)
tyndall_printed(zsh _tyndall zsh/vendor-completions) # where Debian's own packages put theirs
tyndall_printed(fish tyndall.fish fish/vendor_completions.d)
find_program(GZIP_EXECUTABLE gzip REQUIRED)
install(CODE "execute_process(COMMAND ${CMAKE_CROSSCOMPILING_EMULATOR} \"$<TARGET_FILE:tyndall>\" help man
                              COMMAND \"${GZIP_EXECUTABLE}\" -9n
                              OUTPUT_FILE \"${manual}/tyndall.1.gz\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${manual}/tyndall.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

# A package is for processors of all kinds: a folder that lacks instruction sets is refused.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/check_package.cmake @ONLY CONTENT [[
if(NOT "@instruction_sets@" STREQUAL "@all_instruction_sets@")
  message(FATAL_ERROR "this folder lacks kernels that other processors need (it has: scalar @instruction_sets@); "
                      "\"cmake --preset package && cmake --build --preset package\" builds one that can be packed")
endif()
]])
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/check_package.cmake)
set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_PACKAGE_NAME tyndall)
set(CPACK_PACKAGE_VENDOR Tyndall)
set(CPACK_PACKAGE_CONTACT "The authors of Tyndall <tyndall@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "progressive path tracer for glass, brushed metal and fog")
set(CPACK_PACKAGE_DESCRIPTION "Computes pictures by following light paths at random, in a window where each value is a
slider, or headless for tests and farms. It says how accurate each picture is, and gives the same bits
for any number of threads and machines.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_FILE_NAME tyndall-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL tyndall libtyndall libtyndall-dev)
set(same_version "(= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_TYNDALL_PACKAGE_NAME tyndall)
set(CPACK_DEBIAN_LIBTYNDALL_PACKAGE_NAME libtyndall${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_LIBTYNDALL_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBTYNDALL_PACKAGE_RECOMMENDS "tyndall") # the built-in scenes
set(CPACK_DEBIAN_LIBTYNDALL_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_LIBTYNDALL_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(CPACK_DEBIAN_LIBTYNDALL-DEV_PACKAGE_NAME libtyndall-dev)
set(CPACK_DEBIAN_LIBTYNDALL-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBTYNDALL-DEV_PACKAGE_DEPENDS
    "libtyndall${PROJECT_VERSION_MAJOR} ${same_version}, tyndall ${same_version}")
if(TARGET tyndall_python)
  list(APPEND CPACK_COMPONENTS_ALL python3-tyndall)
  set(CPACK_DEBIAN_PYTHON3-TYNDALL_PACKAGE_NAME python3-tyndall)
  set(CPACK_DEBIAN_PYTHON3-TYNDALL_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON3-TYNDALL_PACKAGE_SHLIBDEPS OFF) # its own library is not installed while it is built
  set(CPACK_DEBIAN_PYTHON3-TYNDALL_PACKAGE_DEPENDS
      "libtyndall${PROJECT_VERSION_MAJOR} ${same_version}, python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3-numpy")
endif()
if(TARGET tyndall_window_libraries)
  set(CPACK_DEBIAN_TYNDALL_PACKAGE_RECOMMENDS "libgl1-mesa-dri, fonts-roboto-unhinted, fonts-jetbrains-mono")
endif()
include(CPack)
