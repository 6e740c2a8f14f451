#!/usr/bin/env bash
# The number of threads is that of the processors which the process may use, and --stats says what decided it.
. "$(dirname "$0")/_common.sh"

# threads_of COMMAND...: the number of threads of a small render that the command starts, and what decided it.
threads_of() {
  expect 0 "$@" "$tyndall" render cornell-box --size 16x16 --spp 1 -q -o x.pfm --stats x.json
  echo "$(json x.json threads) $(json x.json threads_from)"
}

same 'threads that are asked for' "$(expect 0 "$tyndall" render cornell-box --size 16x16 --spp 1 -t 3 -q -o x.pfm --stats x.json; json x.json threads; json x.json threads_from)" "3
\"option\""
same 'threads of a process that is not bound' "$(threads_of env | cut -d' ' -f1)" "$(nproc)"

if [ "$(nproc)" -gt 1 ] && command -v taskset >/dev/null; then
  first=$(taskset -pc $$ | sed 's/.*: //; s/[-,].*//')
  same 'threads under taskset' "$(threads_of taskset -c "$first")" '1 "affinity"'
  same 'the picture under taskset' "$(taskset -c "$first" "$tyndall" render cornell-box --size 16x16 --spp 2 -q -o y.pfm --stats y.json && json y.json image_hash)" \
    "$(image_hash cornell-box --size 16x16 --spp 2)"
else
  echo 'one processor, or no taskset: bound processes were not tested'
fi

# A quota of the control group, where this machine lets groups be made.
group=$(mktemp -d "/sys/fs/cgroup/cpu/tyndall-XXXXXX" 2>/dev/null)
if [ -n "$group" ] && [ "$(nproc)" -gt 1 ] && echo 50000 2>/dev/null >"$group/cpu.cfs_quota_us"; then
  trap 'rmdir "$group"' EXIT
  same 'threads under a quota of half a processor' \
    "$(threads_of sh -c 'echo $$ >"$0/cgroup.procs" && exec "$@"' "$group")" '1 "quota"'
else
  [ -z "$group" ] || rmdir "$group"
  echo 'no control group can be made here: quotas were tested with files alone (system/processors)'
fi

finish
