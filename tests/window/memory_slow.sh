#!/usr/bin/env bash
# A picture that is too large for a window is refused with the number of bytes, which is what the window takes within a
# tenth, with and without the clean view.
. "$(dirname "$0")/_lib.sh"
command="$tyndall view cornell-box --set /image/width=1500 --set /image/height=1000 --set /render/spp=2"
bash -c 'ulimit -v 300000; "$0" -V' "$tyndall" >probe 2>&1 || { echo 'skipped: sanitizers need more memory'; exit 77; }

for clean in on off; do
  echo "clean $clean" >"$XDG_CONFIG_HOME/tyndall/window.txt"
  # shellcheck disable=SC2086
  (ulimit -v 300000 && exec $command) 2>refused && fail 'it was not refused'
  grep -q 'ulimit -v' refused || fail "it says: $(cat refused)"
  said=$(sed 's/.* takes \([0-9]*\) bytes .*/\1/' refused)
  # shellcheck disable=SC2086
  run_window $command --ui-log "$scratch/log"
  settle
  for _ in 1 2; do # the speed is known then: the coarse clean view has as many pixels as there is time for
    move 5 5
    key r
    settle
  done
  took=$(awk '/^VmHWM/ { print 1024 * $2 }' "/proc/$pid/status")
  echo "clean $clean: said $said, took $took"
  compares "($said / $took - 1) ^ 2 < 0.01" || fail "clean $clean: said $said bytes, took $took"
  kill -TERM "$pid"
  wait "$pid" || true
  trap - EXIT
done
