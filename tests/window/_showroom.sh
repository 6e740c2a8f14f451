# shellcheck shell=bash
# Sourced by scripts that take pictures of the window, with their own arguments: the tyndall binary, the picture. Shows the
# showroom in a window of `width` x `height` pixels, with `options`, on a screen of its own; says where: $pid, $window, $log, and
# $folder for files, which goes away with the script.
set -euo pipefail
tyndall=$(realpath "$1")
picture=$(realpath -m "$2")
if [ -z "${IN_XVFB:-}" ]; then
  IN_XVFB=1 exec xvfb-run -a -s "-screen 0 ${width}x${height}x24 -nolisten tcp" "$0" "$tyndall" "$picture"
fi
folder=$(mktemp -d)
log=$folder/log
: >"$log"
export XDG_CONFIG_HOME=$folder XDG_STATE_HOME=$folder
"$tyndall" view showroom "${options[@]}" --ui-log "$log" &
pid=$!
trap 'kill $pid 2>/dev/null || true; rm -rf "$folder"' EXIT
window=$(xdotool search --sync --onlyvisible --name 'Tyndall$' | head -1)
xdotool windowsize --sync "$window" "$width" "$height"
