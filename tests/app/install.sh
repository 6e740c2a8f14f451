#!/usr/bin/env bash
# What "cmake --install" puts where: a program that works without the sources, its manual, completion for three shells.
. "$(dirname "$0")/_common.sh"
build=$(dirname "$tyndall")
[ -f "$build/cmake_install.cmake" ] || { echo "skipped: $build is no build folder"; exit 77; }
cmake --install "$build" --prefix "$PWD/there" --strip >log 2>&1 || { cat log; fail 'cmake --install failed'; }
share=there/share
for file in there/bin/tyndall $share/tyndall/scene.schema.json $share/tyndall/scenes/showroom.json \
  $share/man/man1/tyndall.1.gz $share/bash-completion/completions/tyndall $share/zsh/vendor-completions/_tyndall \
  $share/fish/vendor_completions.d/tyndall.fish $share/applications/tyndall.desktop $share/mime/packages/tyndall.xml \
  $share/icons/hicolor/scalable/apps/tyndall.svg $share/doc/tyndall/copyright there/include/tyndall/watch.h \
  there/include/tyndall/tyndall.h; do
  [ -s $file ] || fail "$file was not installed"
done
[ -z "$(find there -name '.*' -o -name '__pycache__' -o -name '*.md~')" ] || fail "installed too much: $(find there -name '.*')"
[ -z "$(find there -type l ! -name 'libtyndall*.so*')" ] || fail 'links are installed'
! grep -rlF -- "$source_root" there >found || fail "the folder of the sources is named in $(cat found)"

# Moved elsewhere it finds its scenes, which are those of the sources.
mv there moved
moved=$PWD/moved/bin/tyndall
same 'scenes' "$("$tyndall" scenes)" "$(env -u TYNDALL_ASSETS "$moved" scenes)"
expect 0 env -u TYNDALL_ASSETS "$moved" render earth --size 16x9 --spp 1 -q -o earth.pfm
same 'program' "$(md5sum <earth.pfm)" "$("$tyndall" render earth --size 16x9 --spp 1 -q -o - --format pfm | md5sum)"
grep -q '^compiler .* Release\|^compiler' <("$moved" version) || fail 'the version does not name the compiler'

# So it does with the headers by which it reads programs.
"$moved" version | grep -q '^guard  *none$' || expect 0 env -u TYNDALL_ASSETS "$moved" convert "$source_root/tests/book/first/main.cc" -o main.json

# The manual names all commands and options, and man has nothing to complain about.
share=moved/share
gzip -dc $share/man/man1/tyndall.1.gz >tyndall.1
for command in $("$moved" --help | sed -n 's/^  \([a-z]*\)  .*/\1/p'); do
  [ "$command" = help ] && continue
  for option in $("$moved" "$command" --help | grep -oE '^  (-[a-z],)?--[a-z0-9-]+' | grep -oE '\-\-[a-z0-9-]+'); do
    grep -qF -- "\\fB${option//-/\\-}" tyndall.1 || fail "the manual lacks $option of $command"
    grep -qF -- " ${option#--} " $share/fish/vendor_completions.d/tyndall.fish ||
      grep -qE -- "-l ${option#--}( |$)" $share/fish/vendor_completions.d/tyndall.fish || fail "fish lacks $option"
  done
done
if command -v man >/dev/null; then
  warnings=$(LC_ALL=C.UTF-8 MANWIDTH=100 man --warnings -E UTF-8 -l tyndall.1 2>&1 >page)
  [ -z "$warnings" ] || fail "man: $warnings"
fi

# completed WORD...: what bash offers for the last word.
completed() {
  PATH=$PWD/moved/bin:$PATH bash -c '
    compopt() { :; }
    . moved/share/bash-completion/completions/tyndall
    COMP_WORDS=(tyndall "$@") COMP_CWORD=$#
    _tyndall
    printf "%s\n" "${COMPREPLY[@]}"' bash "$@" | sort | tr '\n' ' '
}
touch 'a scene.json'
same 'commands' 'render ' "$(completed ren)"
same 'options' '--sampler --samples ' "$(completed render --samp)"
same 'values' 'mis nee path ' "$(completed render cover --integrator '')"
same 'a value after =' 'chains ' "$(completed render cover --caustics = c)"
same 'switches' 'off on ' "$(completed render cover --dither '')"
same 'scenes' 'cornell-box cornell-smoke ' "$(completed render cornell)"
same 'files' 'a scene.json ' "$(completed render 'a s')"
same 'files as values' 'a scene.json ' "$(completed render cover -o 'a ')"
same 'numbers' ' ' "$(completed render cover --spp '')"
if command -v zsh >/dev/null; then
  zsh -n $share/zsh/vendor-completions/_tyndall || fail 'zsh cannot read its completion'
fi
if command -v fish >/dev/null; then
  offered=$(PATH=$PWD/moved/bin:$PATH HOME=$PWD fish --no-config -c \
    "source $share/fish/vendor_completions.d/tyndall.fish; complete -C 'tyndall render cover --integrator '")
  same 'fish' 'mis nee path' "$(printf '%s\n' "$offered" | cut -f 1 | sort | xargs)"
fi
if command -v desktop-file-validate >/dev/null; then
  desktop-file-validate $share/applications/tyndall.desktop || fail 'the desktop file'
fi
finish
