#!/usr/bin/env bash
# However a window ends, nothing is lost, and its last words are true: a click into its title bar, a signal, a kill, a full
# disk, files that are still written and one that cannot be. What the window asks before, tests without a display see to.
. "$(dirname "$0")/_lib.sh"

begin() { # ARGUMENTS
  start "$@"
  settle
}
edit_and_end() { # FUZZ TEXT...: an edit, then SIGTERM; see ends_with
  type_value gold.fuzz.value "$1"
  sleep 0.5 # the line is to be true of edits that were kept as of those that were not
  kill -TERM "$pid"
  ends_with 143 "${@:2}"
}
kept_holds() { grep -qs "\"fuzz\": $1" state/tyndall/unsaved-*.json; }

# The button asks; Save writes.
write_scene scene.json 0.1
begin scene.json
type_value gold.fuzz.value 0.2
press_close_button
wait_for '^widget dialog.save '
point dialog.save 50
xdotool click 1
ends_with 0
grep -q '"fuzz": 0.2' scene.json || fail 'not saved'
! ls state/tyndall/unsaved-*.json 2>/dev/null || fail 'edits are still kept'

# A signal, then a kill: what was kept within a moment is there, also without a scene's name and with other settings.
begin scene.json
edit_and_end 0.3 'the edits of scene.json are kept'
begin scene.json
wait_until has_value gold.fuzz 0.3
type_value gold.fuzz.value 0.4
wait_until kept_holds 0.4
kill -KILL "$pid"
ends_with 137
begin --spp 3 --set /materials/gold/fuzz=0.7
has_value gold.fuzz 0.4 || fail 'an edit was taken back'
has_value render.spp 3 || fail 'kept edits took the place of --spp 3'
finish

# A state folder that cannot be made; and a scene that came by standard input, which has no place.
XDG_STATE_HOME=/dev/null/x begin scene.json
edit_and_end 0.5 'the edits of scene.json are kept in ' '.scene.json.unsaved-1 and come back at the next start'
rm .scene.json.unsaved-1
piped_window() { # COMMAND...: a window over standard input, which the command starts
  run_window "$@" view - --ui-log "$scratch/log" <scene.json
  find_window
  enlarge
  settle
}
XDG_STATE_HOME=/dev/null/x piped_window "$tyndall"
edit_and_end 0.7 'the edits of standard input are lost: ' 'Not a directory'

# A full disk, which has room again later.
if unshare -rm true 2>/dev/null; then
  mkdir full
  full_window() { # COMMAND...: the command where "full" is a full disk, which has room again when it is ordered
    XDG_STATE_HOME=$scratch/full exec unshare -rm bash -c '
      mount -t tmpfs -o size=64k,nr_inodes=64 tmpfs full && head -c 65536 /dev/zero >full/filler
      "$@" <&3 3<&- & child=$!
      read -r _ <"$0/order" && rm full/filler
      for _ in $(seq 1500); do sleep 0.1; cp full/tyndall/unsaved-1.json "$0/kept.json" 2>/dev/null && break; done
      wait $child' "$scratch" "$@" 3<&0
  }
  mkfifo order
  piped_window full_window "$tyndall"
  type_value gold.fuzz.value 0.8
  wait_for '^message edits cannot be kept: .*No space left'
  echo room >order
  wait_for '^message edits can be kept again, and are'
  wait_until test -s kept.json
  grep -q '"fuzz": 0.8' kept.json || fail 'edits are not kept when the disk has room again'
  finish
fi

# Closing while a snapshot is written: the window stays until the files are there, and says so.
begin scene.json --set /image/width=900 --set /image/height=800
lines=$(here)
xdotool key --delay 60 ctrl+p key --delay 60 ctrl+q
wait_for '^closing writes' "$lines"
ends_with 0
for file in scene-001.png scene-001.exr; do [ -s "$file" ] || fail "$file is missing"; done

# A snapshot that cannot be written keeps a closing window open, which says where the picture is instead; a signal's last
# line, or the window's, says it.
export TMPDIR=$scratch/temporary
mkdir "$TMPDIR"
for way in close signal; do
  cd "$scratch" && mkdir gone && cd gone
  begin ../scene.json
  rmdir ../gone
  lines=$(here)
  if [ $way = close ]; then
    xdotool key --delay 60 ctrl+p key --delay 60 ctrl+q
    wait_for "^message .*scene-001.png: cannot write: .*it is in $TMPDIR/tyndall-" "$lines"
    sleep 1
    kill -0 "$pid" || fail 'the window closed, and nobody has seen the message'
    ls "$TMPDIR"/tyndall-*/scene-001.png >/dev/null || fail 'the snapshot is lost'
    finish
  else
    xdotool key --delay 60 ctrl+p
    wait_for '^message saving scene-' "$lines"
    kill -TERM "$pid"
    ends_with 143
    grep -q 'scene-001.png: cannot write: .* instead' "$scratch/errors" ||
      logged '^message .*scene-001.png: cannot write: .* instead' "$lines" || fail 'a snapshot is lost without a word'
  fi
done
