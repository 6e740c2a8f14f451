#!/usr/bin/env bash
# assets/farm/parallel.sh with names that hold anything: on this machine, and on one that is this machine with another home,
# reached by a stand-in for ssh, to which the scene is sent and from which the parts come back.
. "$(dirname "$0")/../app/_common.sh"
. "$source_root/tests/farm/_odd_names.sh"
for program in parallel rsync; do
  command -v $program >probe || { echo "skipped: $program is missing"; exit 77; }
done
mkdir near far bin
# ssh joins its words with spaces, and the shell of the other machine reads them.
cat >bin/ssh <<SSH && chmod +x bin/ssh
#!/bin/sh
while [ "\${1#-}" != "\$1" ]; do case \$1 in -[loipF]) shift 2 ;; *) shift ;; esac; done
shift
[ "\$1" != -- ] || shift
cd "$PWD/far" && HOME=\$PWD && export HOME && exec /bin/sh -c "\$*"
SSH
far="$PWD/bin/ssh far"
export TYNDALL=$tyndall SHARDS=2 SAMPLES=4 HOME=$PWD/near
"$tyndall" convert cornell-box --set '/name="two $words {} %s"' -o box.json
whole=$(image_hash box.json --size 8x8 --samples 0:4)
mkdir near/work && cd near/work || exit 1
for machine in : "$far"; do
  for name in "${odd_names[@]}"; do
    cp ../../box.json "./$name.json"
    expect 0 env MACHINES="$machine" "$source_root/assets/farm/parallel.sh" "$name.json" "$name.exr" --size 8x8 --seed 0
    same "what $name says" "$(printf '%q: all 4 samples' "$name.exr")" "$(tail -1 out)"
    "$tyndall" render "./$name.json" --size 8x8 --samples 0:4 --resume -q -o "./$name.exr" --stats farm.json 2>log
    same "hash of $name" "$whole" "$(json farm.json image_hash)"
    [ "$machine" = : ] || [ -f "../../far/work/$name.exr.parts/1.exr" ] || fail "$name: not rendered on the other machine"
    rm -r "./$name.exr" "./$name.exr.parts"
  done
done
[ -z "$(find ../.. -name 'pwned*')" ] || fail 'a name was run as a command'
expect 0 env HOME= "$source_root/assets/farm/parallel.sh" "${odd_names[0]}.json" home.exr --size 8x8
expect 2 "$source_root/assets/farm/parallel.sh" - out.exr
finish
