#!/usr/bin/env bash
# What the window says of edits that are in no file is true: where they cannot be kept it says so at the first edit, with
# the reason, and its last line does not promise them; where they are kept beside the scene they come back from there.
. "$(dirname "$0")/_lib.sh"

edit_and_end() { # TEXT...: an edit, then SIGTERM; see ends_with
  type_value gold.fuzz.value "$1"
  shift
  sleep 0.5 # the line is to be true of edits that were kept as of those that were not
  kill -TERM "$pid"
  ends_with 143 "$@"
}
fuzz_is() { [ "$(value gold.fuzz)" = "$1" ] || fail "fuzz is $(value gold.fuzz), expected $1"; }
times_said() { grep -c "^message $1" log || true; }

# A state folder that cannot be made: kept beside the scene, told once, and back from there.
mkdir scenes
write_scene scenes/scene.json 0.1
export XDG_STATE_HOME=/dev/null/x
start scenes/scene.json
settle
type_value gold.fuzz.value 0.2
wait_for '^message edits are kept in .*scenes/\.scene\.json\.unsaved-1, because of: .*Not a directory'
type_value gold.fuzz.value 0.3
[ "$(times_said 'edits are kept')" = 1 ] || fail "it is said $(times_said 'edits are kept') times"
edit_and_end 0.4 'the edits of scene.json are kept in ' '.scene.json.unsaved-1 and come back at the next start'
[ "$(ls -A scenes)" = ".scene.json.unsaved-1
scene.json" ] || fail "left beside the scene: $(ls -A scenes)"
start scenes/scene.json
wait_for '^message restored the edits of scene.json'
fuzz_is 0.4
chord ctrl s # asks, as the scene has comments
wait_for '^widget dialog.save '
click dialog.save
wait_for '^saved '
wait_until_saved() { [ ! -e scenes/.scene.json.unsaved-1 ]; }
wait_until wait_until_saved
finish

# HOME and XDG_STATE_HOME unset, or relative: the same.
for setting in 'unset HOME XDG_STATE_HOME' 'export HOME=home XDG_STATE_HOME=state'; do
  (
    eval "$setting"
    start scenes/scene.json
    settle
    edit_and_end 0.5 'the edits of scene.json are kept in '
    [ ! -e state ] && [ ! -e home ] || fail 'a relative path was taken for a folder of the user'
    start scenes/scene.json
    wait_for '^message restored the edits of scene.json'
    fuzz_is 0.5
    finish # without saving
    [ ! -e scenes/.scene.json.unsaved-1 ] || fail 'edits that were given up are kept'
  ) || exit 1
done

# Nowhere: scenes that came by standard input have no place. Said once, and the last line says that they are lost.
piped_window() { # COMMAND...: a window over standard input, which the command starts
  : >"$scratch/log"
  "$@" view - --ui-log "$scratch/log" <scenes/scene.json 2>"$scratch/errors" &
  pid=$!
  trap 'kill $pid 2>/dev/null || true' EXIT
  find_window
  enlarge
}
piped_window "$tyndall"
settle
type_value gold.fuzz.value 0.6
wait_for '^message edits cannot be kept: .*Not a directory.*lost when the window ends'
type_value gold.fuzz.value 0.65
[ "$(times_said 'edits cannot be kept')" = 1 ] || fail "it is said $(times_said 'edits cannot be kept') times"
edit_and_end 0.7 'the edits of standard input are lost: ' 'Not a directory'

# A full disk: the same, until there is room again.
if unshare -rm true 2>/dev/null; then
  mkdir full
  mount_full='mount -t tmpfs -o size=64k,nr_inodes=64 tmpfs full && head -c 65536 /dev/zero >full/filler'
  export mount_full
  full_window() { # COMMAND...: the command where "full" is a full disk, which has room again when it is ordered
    XDG_STATE_HOME=$scratch/full exec unshare -rm bash -c 'eval "$mount_full"; "$@" <&3 3<&- & child=$!
      read -r _ <"$0/order" && rm full/filler
      for _ in $(seq 1500); do sleep 0.1; cp full/tyndall/unsaved-1.json "$0/kept.json" 2>/dev/null && break; done
      wait $child' "$scratch" "$@" 3<&0
  }
  mkfifo order
  piped_window full_window "$tyndall"
  settle
  type_value gold.fuzz.value 0.8
  wait_for '^message edits cannot be kept: .*No space left'
  echo room >order
  wait_for '^message edits can be kept again, and are'
  wait_until test -s kept.json
  grep -q '"fuzz": 0.8' kept.json || fail 'edits are not kept when the disk has room again'
  finish
fi

# A snapshot that cannot be written keeps a closing window open, which says where the picture is instead; a signal's
# last line says it.
export TMPDIR=$scratch/temporary XDG_STATE_HOME=$scratch/state
mkdir "$TMPDIR" gone
cd gone
start ../scenes/scene.json
settle
rmdir ../gone
lines=$(here)
xdotool key --delay 60 ctrl+p key --delay 60 ctrl+q
wait_for "^message .*scene-001.png: cannot write: .*it is in $TMPDIR/tyndall-" "$lines"
sleep 1
kill -0 "$pid" || fail 'the window closed, and nobody has seen the message'
ls "$TMPDIR"/tyndall-*/scene-001.png >/dev/null || fail 'the snapshot is lost'
finish
cd "$scratch"
mkdir gone && cd gone
start ../scenes/scene.json
settle
rmdir ../gone
lines=$(here)
xdotool key --delay 60 ctrl+p
wait_for '^message saving scene-' "$lines"
kill -TERM "$pid"
status=0
wait "$pid" || status=$?
trap - EXIT
[ "$status" = 143 ] || fail "exit code $status after SIGTERM"
# The window's own line is seen where the file failed before the signal came.
grep -q 'scene-001.png: cannot write: .* instead' \
  "$scratch/errors" || logged '^message .*scene-001.png: cannot write: .* instead' "$lines" || fail 'a snapshot is lost without a word'
