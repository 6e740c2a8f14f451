# "cmake --install" and, by CPack, a zip that runs from any folder: the program, and beside it what it reads in
# the folder assets. Included by CMakeLists.txt.
enable_language(RC)
target_sources(tyndall PRIVATE assets/desktop/windows/tyndall.rc)
set(fonts /usr/share/fonts/truetype)
set(TYNDALL_FONTS "${fonts}/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf;${fonts}/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf;${fonts}/jetbrains-mono/JetBrainsMono-Regular.ttf"
    CACHE STRING "fonts of the window that are packed with the program")
set(TYNDALL_NOTICES "${TYNDALL_MINGW_LIBRARIES}/licenses" CACHE PATH
    "a folder with the notices of the libraries and fonts that are packed with the program")

set(share assets) # where a program finds them that was not installed
install(TARGETS tyndall RUNTIME DESTINATION .)
install(FILES assets/scene.schema.json DESTINATION ${share})
install(DIRECTORY assets/scenes assets/templates assets/textures assets/verify DESTINATION ${share}
        FILES_MATCHING REGEX "\\.(json|csv|html|png|jpg)$")
install(FILES ${TYNDALL_FONTS} DESTINATION ${share}/fonts OPTIONAL)
install(DIRECTORY ${TYNDALL_NOTICES}/ DESTINATION notices)
install(FILES LICENSE DESTINATION . RENAME LICENSE.txt)
install(FILES assets/desktop/windows/README.md DESTINATION . RENAME README.txt)
set(CPACK_GENERATOR ZIP)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_FILE_NAME tyndall-${PROJECT_VERSION}-windows-x86_64)
include(CPack)
