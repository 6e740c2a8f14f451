#!/usr/bin/env bash
# The README's picture of the window: the showroom when it is finished.
# Arguments: the tyndall binary, the picture.
width=1600 height=900 options=(--spp 128)
. "$(dirname "$0")/_showroom.sh"
until grep -qE '^size 1600 900' "$log" && [ "$(tail -1 "$log")" = rest ]; do sleep 0.1; done
import -window "$window" "$picture"
