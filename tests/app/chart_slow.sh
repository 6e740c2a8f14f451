#!/usr/bin/env bash
# chart: files, table, methods, references, interruption.
. "$(dirname "$0")/_common.sh"

expect 0 "$tyndall" chart cornell-box --size 32x32 --budget 0.6 -q -o box.svg :out "^the books' method" :quiet
head -c 4 box.svg | grep -q '<svg' || fail 'no chart'
python3 -c 'import xml.dom.minidom, sys; xml.dom.minidom.parse("box.svg")' || fail 'the chart is no XML'
head -1 box.csv | grep -qx 'method,spp,seconds,relmse' || fail "header: $(head -1 box.csv)"

# Of chosen methods, against a file; max-depth 1 is biased, and that is seen.
expect 0 "$tyndall" render cornell-box --size 32x32 --spp 4096 --sampler random --seed 5 -q -o reference.pfm
expect 0 "$tyndall" chart cornell-box --size 32x32 --budget 2 -q -o two.svg --reference reference.pfm \
  --method 'whole=' --method 'direct light=--max-depth 1'
grep -q 'direct light (floor 0' two.svg || fail 'the floor of cut paths is not seen'
expect 0 "$tyndall" chart cornell-box --size 32x32 --budget 2 -q -o two.svg \
  --method 'whole=' --method 'direct light=--max-depth 1'
[ "$(cut -d, -f1 two.csv | sort -u | wc -l)" -eq 3 ] || fail "methods: $(cut -d, -f1 two.csv | sort -u)"
grep -q 'direct light (bias 0' two.svg || fail 'the bias of cut paths is not seen'
grep -q 'whole (bias' two.svg && fail 'a bias is seen where there is none'
expect 2 "$tyndall" chart cornell-box --size 16x16 -q -o a.svg --reference reference.pfm :: --reference 32x32 16x16
expect 3 "$tyndall" chart cornell-box -q -o nowhere/a.svg :: nowhere

# Ctrl-C writes what there is.
"$tyndall" chart cornell-box --size 32x32 --budget 20 -q --reference reference.pfm -o cut.svg >out 2>err &
chart=$! code=0
wait_worked "$chart" 4
kill -INT "$chart"
wait "$chart" || code=$?
[ "$code" -eq 130 ] || fail 'exit code after Ctrl-C'
[ -s cut.svg ] && [ "$(wc -l <cut.csv)" -gt 3 ] || fail "nothing written at Ctrl-C: $(cat err)"
exit $((failures > 0))
