#!/usr/bin/env bash
# assets/farm/slurm.sh with names that hold anything, on a stand-in for sbatch that runs each job at once and takes names of
# logs as sbatch's manual says ("filename pattern": % begins a symbol, \ switches symbols off and goes).
. "$(dirname "$0")/../app/_common.sh"
. "$source_root/tests/farm/_odd_names.sh"
mkdir bin && cat >bin/sbatch <<'SBATCH' && chmod +x bin/sbatch
#!/usr/bin/env bash
while [[ $1 = -* ]]; do
  case $1 in
    --array=*) IFS=- read -r first last <<<"${1#*=}" ;;
    --output=*) logs=${1#*=} ;;
  esac
  shift
done
for ((task = ${first:-0}; task <= ${last:-0}; ++task)); do
  log=${logs//%%/$'\1'} log=${log//%a/$task} log=${log//%[A-Za-z]/7}
  log=${log//$'\1'/%}
  [[ $logs != *\\* ]] || log=${logs//\\/}
  [ -z "$last" ] || export SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_JOB_ID=7
  bash "$@" >>"$log" 2>&1 </dev/null
done
echo 7
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
