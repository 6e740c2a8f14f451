#!/usr/bin/env bash
# All of tyndall verify: on every instruction set, with every integrator and sampler, with other seeds.
. "$(dirname "$0")/_common.sh"

check() {
  expect 0 "$tyndall" verify -q "$@"
  tail -n 2 out
  grep FAIL out
}

for isa in scalar sse4 avx2 avx512 neon; do
  "$tyndall" render cornell-box --size 8x8 --spp 1 -q -o probe.pfm --isa $isa 2>probe.err && check --isa $isa
done
for integrator in path nee mis; do check --integrator $integrator --sampler random --seed 1000000; done
for integrator in path nee; do check --integrator $integrator --seed 2000000; done

finish
