#!/usr/bin/env bash
# render --watch-at: the picture in a viewer that speaks tev's protocol, and viewers that fail. Loopback only.
. "$(dirname "$0")/_common.sh"
viewer() { # MODE HOST: starts one; its port is in $port
  rm -f port seen.json
  python3 "$source_root/tests/app/_viewer.py" "$1" "$2" "$PWD/port" "$PWD/seen.json" 2>viewer.err &
  viewer=$!
  for _ in $(seq 200); do [ -e port ] && break; sleep 0.05; done
  port=$(cat port) || fail "no viewer: $(cat viewer.err)"
}
scene=(cornell-box --size 48x32 --spp 16)

# What the viewer has in the end is the picture: R, G, B, the error, the clean view; by name, by address, of IPv6 too.
hosts=(127.0.0.1 localhost)
grep -q ' 00000000000000000000000000000001 ' /proc/net/if_inet6 2>/dev/null || python3 -c '
import socket; socket.socket(socket.AF_INET6).bind(("::1", 0))' 2>/dev/null && hosts+=('[::1]')
for host in "${hosts[@]}"; do
  listen=${host//[\[\]]/}
  viewer read "${listen/localhost/127.0.0.1}"
  rm -f picture.exr
  expect 0 "$tyndall" render "${scene[@]}" -q --denoise -o picture.exr -o picture.pfm --watch-at "$host:$port" :quiet
  wait "$viewer" || fail "$host: the viewer: $(cat viewer.err)"
  python3 - <<'PY' || fail "$host: what the viewer has seen"
import json, struct
with open("seen.json") as file:
    seen = json.load(file)
assert list(seen) == ["cornell-box"], list(seen)
picture = seen["cornell-box"]
assert (picture["width"], picture["height"]) == (48, 32)
assert picture["channels"] == ["R", "G", "B", "error", "clean.R", "clean.G", "clean.B"], picture["channels"]
values = picture["values"]
assert all(v is not None for c in values.values() for v in c)
with open("picture.pfm", "rb") as file:
    assert file.readline() == b"PF\n" and file.readline() == b"48 32\n" and file.readline()
    data = struct.unpack("<4608f", file.read())
for name, c in (("clean.R", 0), ("clean.G", 1), ("clean.B", 2)):
    rows = [data[3 * (y * 48 + x) + c] for y in reversed(range(32)) for x in range(48)]
    assert rows == values[name], name
assert 0.01 < sum(values["error"]) / 1536 < 1, sum(values["error"]) / 1536
assert values["R"] != values["clean.R"] and abs(sum(values["R"]) / sum(values["clean.R"]) - 1) < 0.1
PY
done

# Of a region the viewer gets the whole picture's place.
viewer read 127.0.0.1
expect 0 "$tyndall" render "${scene[@]}" --region 8,4,20,10 -q -o part.pfm --watch-at "127.0.0.1:$port"
wait "$viewer" || fail "a region: $(cat viewer.err)"
same 'pixels of a region' 72 "$(python3 -c '
import json
print(sum(v is not None for v in json.load(open("seen.json"))["cornell-box"]["values"]["R"]))')"

# A viewer that is not there, stops reading, closes or never accepts: the same picture, exit code 0, at most one line.
expect 0 "$tyndall" render "${scene[@]}" -q -o plain.pfm
expect 0 "$tyndall" render "${scene[@]}" -q -o nobody.pfm --watch-at 127.0.0.1:1
complains '--watch-at: 127.0.0.1:1: Connection refused; the render goes on without it'
expect 0 "$tyndall" render "${scene[@]}" -q -o name.pfm --watch-at no-such-host.invalid
[ "$(wc -l <err)" -le 1 ] || fail "more than one line: $(cat err)"
for mode in stop close hang; do
  viewer "$mode" 127.0.0.1
  start=$(date +%s%N)
  expect 0 "$tyndall" render cornell-box --size 640x480 --spp 4 -q -o "$mode.pfm" --watch-at "127.0.0.1:$port"
  [ "$(wc -l <err)" -le 1 ] || fail "$mode: more than one line: $(cat err)"
  [ "$mode" = hang ] || grep -q "^tyndall: --watch-at: 127.0.0.1:$port: the viewer has " err || fail "$mode: $(cat err)"
  [ $((($(date +%s%N) - start) / 1000000)) -lt 10000 ] || fail "$mode: the render waited for its viewer"
  kill "$viewer" 2>/dev/null
  wait "$viewer" 2>/dev/null
done
cmp -s plain.pfm nobody.pfm || fail 'a viewer changed the picture'
cmp -s stop.pfm close.pfm || fail 'a viewer that stops reading changed the picture'

finish
