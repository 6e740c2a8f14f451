#!/usr/bin/env bash
# The README's picture of the window: the showroom when it is finished.
# Arguments: the tyndall binary, the picture.
set -euo pipefail
tyndall=$(realpath "$1")
picture=$(realpath -m "$2")
if [ -z "${IN_XVFB:-}" ]; then
  IN_XVFB=1 exec xvfb-run -a -s '-screen 0 1600x900x24 -nolisten tcp' "$0" "$tyndall" "$picture"
fi
folder=$(mktemp -d)
log=$folder/log
: >"$log"
export XDG_CONFIG_HOME=$folder XDG_STATE_HOME=$folder
"$tyndall" view showroom --spp 128 --ui-log "$log" &
pid=$!
trap 'kill $pid 2>/dev/null || true; rm -rf "$folder"' EXIT
window=$(xdotool search --sync --onlyvisible --name 'Tyndall$' | head -1)
xdotool windowsize --sync "$window" 1600 900
until grep -qE '^size 1600 900' "$log" && [ "$(tail -1 "$log")" = rest ]; do sleep 0.1; done
import -window "$window" "$picture"
