#!/usr/bin/env bash
# assets/farm/parallel.sh on this machine alone: the bits of one render, also when it is started again after half of it. Then
# with names that hold anything: on this machine, and on one that is this machine with another home,
# reached by a stand-in for ssh, to which the scene is sent and from which the parts come back.
. "$(dirname "$0")/../app/_common.sh"
. "$source_root/tests/farm/_odd_names.sh"
for program in parallel rsync; do
  command -v $program >probe || { echo "skipped: $program is missing"; exit 77; }
done
export HOME=$PWD TYNDALL=$tyndall SHARDS=4 SAMPLES=10
mkdir -p .parallel near far bin && touch .parallel/will-cite
whole=$(image_hash cornell-smoke --size 24x24 --samples 0:10)
expect 0 "$source_root/assets/farm/parallel.sh" cornell-smoke farm.exr --size 24x24
same 'standard output' 'farm.exr: all 10 samples' "$(tail -1 out)"
rm farm.exr farm.exr.parts/2.exr
expect 0 "$source_root/assets/farm/parallel.sh" cornell-smoke farm.exr --size 24x24
expect 0 "$tyndall" render cornell-smoke --size 24x24 --samples 0:10 --resume -q -o farm.exr --stats farm.json
same 'hash' "$whole" "$(json farm.json image_hash)"
expect 2 env SHARDS=11 "$source_root/assets/farm/parallel.sh" cornell-smoke farm.exr
expect 2 "$source_root/assets/farm/parallel.sh" cornell-smoke

# ssh joins its words with spaces, and the shell of the other machine reads them.
cat >bin/ssh <<SSH && chmod +x bin/ssh
#!/bin/sh
while [ "\${1#-}" != "\$1" ]; do case \$1 in -[loipF]) shift 2 ;; *) shift ;; esac; done
shift
[ "\$1" != -- ] || shift
cd "$PWD/far" && HOME=\$PWD && export HOME && exec /bin/sh -c "\$*"
SSH
far="$PWD/bin/ssh far"
export SHARDS=2 SAMPLES=4 HOME=$PWD/near
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
