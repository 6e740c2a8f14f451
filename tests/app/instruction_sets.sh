#!/usr/bin/env bash
# An instruction set that this CPU runs and this build lacks is refused with the command that builds it.
. "$(dirname "$0")/_common.sh"
missing=$("$tyndall" version | sed -n 's/^kernels .* could run \([a-z0-9 ]*\);.*/\1/p')
"$tyndall" inspect quads --json | grep -q '"built_sets"' || fail 'inspect does not say which sets are built'
for set in $missing; do
  for command in 'render quads --spp 1 -o x.png' 'sweep quads --vary /camera/vfov=30:40:2 -o x.png' 'inspect quads --measure'; do
    # shellcheck disable=SC2086
    expect 2 "$tyndall" $command --isa "$set"
    grep -q "found \"$set\".*TYNDALL_INSTRUCTION_SETS=all ./run" err || fail "$command --isa $set: $(cat err)"
  done
done
expect 2 "$tyndall" inspect --accuracy :err 'tests/README.md.*tyndall_bench approximations'
finish
