# shellcheck shell=bash
# Sourced by run and test: the system packages that Tyndall needs, and how they get installed.
# Debian 12 and later, Ubuntu 22.04 and later: installed as root or through sudo. Other systems: the list is printed.
# TYNDALL_SKIP_PACKAGES=1 skips all of it.
. "$(dirname "${BASH_SOURCE[0]}")/switches.sh"
skip_packages=0
! is_on TYNDALL_SKIP_PACKAGES || skip_packages=1

# Used by the scripts that source this file.
# shellcheck disable=SC2034
build_packages=(g++ cmake ninja-build pkg-config libglfw3-dev libgl-dev libimgui-dev libstb-dev
  libjpeg-dev libpng-dev python3-glad nlohmann-json3-dev libcli11-dev libfmt-dev doctest-dev libopenexr-dev libhwy-dev)
# shellcheck disable=SC2034
run_packages=(libgl1-mesa-dri fonts-roboto-unhinted fonts-jetbrains-mono)
# shellcheck disable=SC2034
test_packages=(python3-dev pybind11-dev python3-numpy python3-pytest xvfb xauth xdotool libgl1-mesa-dri fonts-roboto-unhinted fonts-jetbrains-mono python3)
# Only ./run web needs them.
# shellcheck disable=SC2034
web_packages=(emscripten node-acorn dpkg-dev cmake ninja-build python3 fonttools libglfw3-dev libstb-dev
  nlohmann-json3-dev libfmt-dev libhwy-dev fonts-roboto-unhinted fonts-jetbrains-mono)
# Only ./test --all needs them: large, and all that they check is style. The version is part of the style.
# shellcheck disable=SC2034
style_packages=(clang-format-14 clang-tidy-14)

packages_changed=0 # 1 after something was installed

# ensure_packages NAME...: returns 1, after saying what to do, when a package is missing and cannot be installed.
ensure_packages() {
  [ "$skip_packages" = 1 ] && return 0
  if ! command -v dpkg-query >/dev/null 2>&1; then
    other_systems
    return 1
  fi
  local package missing=()
  for package in "$@"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    if command -v sudo >/dev/null 2>&1 && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
      as_root=(sudo)
    else
      printf 'Tyndall needs packages that are missing, and this user cannot install them. As root run\n' >&2
      printf '  apt-get install -y --no-install-recommends %s\nand then start this again.\n' "${missing[*]}" >&2
      return 1
    fi
  fi
  printf 'installing packages that Tyndall needs: %s\n' "${missing[*]}" >&2
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0
    -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300)
  local install=("${apt[@]}" install --no-install-recommends "${missing[@]}")
  local log
  # A fresh machine has no package lists: the first try fails.
  log=$("${install[@]}" </dev/null 2>&1) || log=$("${apt[@]}" update </dev/null 2>&1 && "${install[@]}" </dev/null 2>&1) || {
    if grep -qE 'Could not resolve|Temporary failure|Could not connect|Unable to connect|unreachable' <<<"$log"; then
      printf 'Tyndall needs packages, and no server of Debian can be reached; with a network, start this again, or: ' >&2
    else
      printf '%s\napt-get could not install them (its messages are above). As root run: ' "$log" >&2
    fi
    printf 'apt-get install -y --no-install-recommends %s\n' "${missing[*]}" >&2
    return 1
  }
  packages_changed=1
}

other_systems() {
  cat >&2 <<'MSG'
This is not a Debian or Ubuntu system, so Tyndall cannot install the packages that it needs. Install these, then start
again with TYNDALL_SKIP_PACKAGES=1 in front, as in "TYNDALL_SKIP_PACKAGES=1 ./run":
  Fedora:  sudo dnf install gcc-c++ cmake ninja-build pkgconf glfw-devel mesa-libGL-devel stb_image-devel stb_image_write-devel libjpeg-turbo-devel libpng-devel json-devel cli11-devel fmt-devel doctest-devel openexr-devel highway-devel
  Arch:    sudo pacman -S --needed base-devel cmake ninja glfw mesa stb libjpeg-turbo libpng nlohmann-json cli11 fmt doctest openexr highway
The window also needs glad 2 (pip install glad2) and Dear ImGui; to build with its sources, once call
"cmake --preset release -DIMGUI_DIR=FOLDER". Without them Tyndall is built without the window.
MSG
}

# build_folder PRESET: where it is built. In the sources' own folder "build", or, where that cannot be written, in the
# user's cache.
build_folder() {
  local home=${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache} here
  here=$(pwd -P)
  local existing=build/$1
  while [ ! -e "$existing" ]; do existing=$(dirname "$existing"); done
  if [ -w "$existing" ]; then
    printf 'build/%s\n' "$1"
  else
    printf '%s/tyndall/%s-%s\n' "$home" "$1" "$(printf '%s' "$here" | cksum | cut -d ' ' -f 1)"
  fi
}

# configure_build PRESET: configures the folder once, and again after packages came in, on another processor (its kernels
# are others), or for other instruction sets, which the environment's TYNDALL_INSTRUCTION_SETS names. Prints only what went
# wrong. Works in the current folder, the root of the sources.
configure_build() {
  local folder kept='' sets
  folder=$(build_folder "$1")
  [ ! -f "$folder/CMakeCache.txt" ] || kept=$(sed -n 's/^TYNDALL_INSTRUCTION_SETS:[A-Z]*=//p' "$folder/CMakeCache.txt")
  sets=${TYNDALL_INSTRUCTION_SETS:-$kept}
  [ -f "$folder/build.ninja" ] && [ "$packages_changed" = 0 ] && [ "$sets" = "$kept" ] &&
    [ "$(grep -m1 -E '^(flags|Features)' /proc/cpuinfo 2>/dev/null)" = "$(cat "$folder/processor.txt" 2>/dev/null)" ] && return 0
  if ! mkdir -p "$folder" 2>/dev/null; then
    printf 'Tyndall can be built neither in %s/build nor in %s: both cannot be written\n' "$(pwd -P)" "$folder" >&2
    return 1
  fi
  [ "$folder" = "build/$1" ] || printf 'the sources cannot be written to, so Tyndall is built in %s\n' "$folder" >&2
  cmake --preset "$1" -B "$folder" ${sets:+"-DTYNDALL_INSTRUCTION_SETS=$sets"} >/dev/null
}

# compile PRESET [ARGUMENT...]: builds it with one compiler for each processor. Ninja alone would start two more: on two
# processors four of them get in each other's way, and the same files take half as long again. Where nobody sees ninja's
# progress, a line now and then says how far it is, and the messages of the compiler come only when something failed.
compile() {
  local folder log status=0
  folder=$(build_folder "$1")
  shift
  if [ -t 2 ]; then
    cmake --build "$folder" --parallel "$(nproc)" "$@" >&2
    return
  fi
  log=$folder/build.log
  local word targets=()
  for word in "$@"; do
    [ "$word" = --target ] || targets+=("$word")
  done
  cmake --build "$folder" -- -t commands "${targets[@]}" >"$log.planned" 2>/dev/null || :
  cp "$folder/.ninja_log" "$log.before" 2>/dev/null || : >"$log.before"
  cmake --build "$folder" --parallel "$(nproc)" "$@" >"$log" 2>&1 &
  local builder=$! tenths=0
  while kill -0 "$builder" 2>/dev/null; do
    sleep 0.1
    tenths=$((tenths + 1))
    # Soon after the start, then every half minute.
    case $((tenths % (10 * ${TYNDALL_TELL_SECONDS:-30}))),$tenths in
      0,* | *,100) tell_progress "$folder" "$((tenths / 10))" ;;
    esac
  done
  wait "$builder" || status=$?
  [ "$status" -eq 0 ] || cat "$log" >&2
  return "$status"
}

# tell_progress FOLDER SECONDS: says how far the build in FOLDER is after SECONDS, and how long it takes in all. Each
# kind of file is known to take so many seconds on one machine; how much longer this one takes, its first files show.
# Files that were built before count only as ninja numbers them.
tell_progress() {
  { awk -v processors="$(nproc)" -v elapsed="$2" '
    function usual(name) {
      if (name ~ /kernel_sets/) return 90
      if (name ~ /full_kernel/) return 60
      if (name ~ /targets\/scalar/) return 20
      if (name ~ /Unity|cmake_pch/) return 5
      return name ~ /\.o$/ ? 2 : 0.5
    }
    FILENAME == ARGV[1] {
      before[$1, $2, $4]
      built[$4]
    }
    FILENAME == ARGV[2] {
      name = match($0, / -o [^ ]+/) ? substr($0, RSTART + 4, RLENGTH - 4) : $NF
      if (name in built) next
      ++commands
      all += planned[name] = usual(name)
    }
    FILENAME == ARGV[3] && match($1, /\/[0-9]+\]/) { steps = substr($1, RSTART + 1, RLENGTH - 2) }
    FILENAME == ARGV[4] && $4 in planned && !(($1, $2, $4) in before) {
      took += ($2 - $1) / 1000
      done += planned[$4]
      delete planned[$4]
    }
    END {
      if (all == 0 || steps == 0) exit
      if (done < all / 20) took = done = 1 # too few have been finished: as on the usual machine
      minutes = all * steps / commands * took / done / processors / 60
      share = 100 * elapsed / 60 / minutes
      printf "building: about %.1f minutes in all, %d %% of them are over\n", minutes, share < 99 ? share : 99
    }' "$1/build.log.before" "$1/build.log.planned" "$1/build.log" "$1/.ninja_log" 2>/dev/null || :; } >&2
}
