# shellcheck shell=bash
# Sourced by packages.sh and the tests of the window: variables of the environment that say yes or no.

small_letters() { printf '%s' "$1" | tr '[:upper:]' '[:lower:]'; }

# is_on NAME: whether this switch of ours is on. Ends the script where its value is neither yes nor no.
is_on() {
  case $(small_letters "${!1:-}") in
    1 | yes | true | on) return 0 ;;
    0 | no | false | off | '') return 1 ;;
  esac
  printf '%s: found "%s", expected 1, yes, true or on, or 0, no, false, off or nothing\n' "$1" "${!1}" >&2
  exit 2
}

# Whether continuous integration runs this: CI is set to anything but no.
in_ci() {
  case $(small_letters "${CI:-}") in 0 | no | false | off | '') return 1 ;; esac
}
