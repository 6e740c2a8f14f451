#!/usr/bin/env bash
# Programs of readers of the books, of three editions' style, in place of scenes.
. "$(dirname "$0")/_program.sh"
mkdir temporary
export TMPDIR=$PWD/temporary  # of this test alone: others compile at the same time

# agrees PROGRAM SCENE OPTION...: its scene is that one with the options, as far as a camera's members can tell it. Names do
# not count.
agrees() {
  "$tyndall" convert "$1" -o taken.json && "$tyndall" convert "$2" "${@:3}" -o wanted.json &&
    python3 -c '
import json, math
def plain(s):
    def unnamed(o):
        if isinstance(o, dict): return {k: unnamed(s["materials"][v] if k == "material" else v) for k, v in o.items()}
        return unnamed(s["textures"][o]) if isinstance(o, str) and o in s.get("textures", {}) else o
    c = s["camera"]
    eye, at = c["look_from"], c["look_at"]
    to = [b - a for a, b in zip(eye, at)]
    c["look_at"] = [x / math.hypot(*to) for x in to]
    c.pop("vup", None)
    return [s["image"], s["render"], s["background"], c, [unnamed(o) for o in s["objects"]]]
def same(a, b):
    if isinstance(a, dict): return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, list): return len(a) == len(b) and all(map(same, a, b))
    return abs(a - b) < 1e-9 * max(1, abs(a)) if isinstance(a, float) or isinstance(b, float) else a == b
a, b = (plain(json.load(open(f))) for f in ("taken.json", "wanted.json"))
for x, y in zip(a, b):
    if not same(x, y): raise SystemExit(f"{x}\nin place of\n{y}")' || fail "$1 is another scene than $2"
}

# Each program's scene is what it describes. Its folder stays as it is.
cp -r "$source_root/tests/book" copy
before=$(cd copy && find . -type f -exec cksum {} + | sort)
for edition in third first ${TYNDALL_THOROUGH:+newest}; do agrees "copy/$edition/main.cc" "copy/$edition/scene.json"; done
# Options act on it as on any scene; the picture carries the scene.
expect 0 "$tyndall" render copy/newest/main.cc --size 8x6 --set /camera/vfov=30 --max-depth 2 --spp 1 -q -o small.png
agrees small.png copy/newest/scene.json --set /image/width=8 --set /image/height=6 --set /camera/vfov=30 \
  --set /render/max_depth=2 --set /render/spp=1
same "files beside the programs" "$(cd copy && find . -type f -exec cksum {} + | sort)" "$before"
same 'temporary folders left' "$(find temporary -mindepth 1 | wc -l)" 0

finish
