#!/usr/bin/env bash
# assets/farm/slurm.sh with names that hold anything, on a stand-in for sbatch that runs each job at once and takes names of
# logs as sbatch's manual says ("filename pattern": % begins a symbol, \ switches symbols off and goes).
. "$(dirname "$0")/../app/_common.sh"
. "$source_root/tests/farm/_odd_names.sh"
mkdir bin && cat >bin/sbatch <<'SBATCH' && chmod +x bin/sbatch
#!/usr/bin/env python3
import os, re, subprocess, sys
options, words = {}, sys.argv[1:]
while words and words[0].startswith("-"):
    name, _, value = words.pop(0).partition("=")
    options[name] = value
symbols = {"a": "%(task)s", "A": "7", "j": "7", "J": "7", "N": "node", "n": "0", "s": "batch", "t": "0", "u": "root", "x": "tyndall"}
first, last = map(int, options.get("--array", "0-0").split("-"))
for task in range(first, last + 1):
    log = os.path.join(os.getcwd(), options["--output"])
    if "\\" in log:
        log = log.replace("\\", "")
    else:
        log = re.sub(r"%(.)", lambda m: "%" if m[1] == "%" else symbols.get(m[1], "") % {"task": task}, log)
    environment = dict(os.environ)
    if "--array" in options:
        environment.update(SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_JOB_ID="7")
    with open(log, "ab") as out:
        subprocess.run(["bash"] + words, env=environment, stdout=out, stderr=out, stdin=subprocess.DEVNULL)
print(7)
SBATCH
export PATH=$PWD/bin:$PATH TYNDALL=$tyndall SHARDS=2 SAMPLES=4 HOME=
"$tyndall" convert cornell-box --set '/name="two $words {} %s"' -o box.json
whole=$(image_hash box.json --size 8x8 --samples 0:4)
for name in "${odd_names[@]}"; do
  mkdir "in $name" && cp box.json "in $name/$name.json" && cd "in $name" || fail "a folder of that name"
  expect 0 "$source_root/assets/farm/slurm.sh" "$name.json" "$name.exr" --size 8x8
  same "logs of $name" '0.log 1.log merge.log' "$(cd "./$name.exr.parts" && echo *.log)"
  same "what $name says" "$(printf '%q: all 4 samples' "$name.exr")" "$(tail -1 "./$name.exr.parts/merge.log")"
  "$tyndall" render "./$name.json" --size 8x8 --samples 0:4 --resume -q -o "./$name.exr" --stats farm.json 2>log
  same "hash of $name" "$whole" "$(json farm.json image_hash)"
  cd ..
done
[ -z "$(find . -name 'pwned*')" ] || fail 'a name was run as a command'
expect 2 "$source_root/assets/farm/slurm.sh" - out.exr
expect 2 env SHARDS=5 "$source_root/assets/farm/slurm.sh" box.json out.exr
finish
