#!/usr/bin/env bash
# The job for GitHub that app/cli/README.md shows: it is YAML, and its steps do what the page says of them, run as GitHub runs
# them in a container, by "sh -e". The step that installs the package is left to app/package_nightly.sh.
. "$(dirname "$0")/_common.sh"
python3 -c 'import yaml' 2>probe || { echo 'skipped: python3-yaml is missing'; exit 77; }
python3 - "$source_root/app/cli/README.md" <<'PYTHON' || fail 'no job'
import re, sys, yaml
block = re.search(r"```yaml\n(.*?)```", open(sys.argv[1], encoding="utf-8").read(), re.S).group(1)
job = yaml.safe_load(block)["jobs"]["pictures"]
steps = [step["run"] for step in job["steps"] if "run" in step]
assert "apt-get install" in steps[0] and len(steps) == 3, steps
assert {"runs-on", "container", "steps"} == set(job), job
for number, step in enumerate(steps[1:], 1):
    open(f"step{number}.sh", "w", encoding="utf-8").write(step)
PYTHON
mkdir -p scenes bin tests && ln -s "$tyndall" bin/tyndall
for scene in cornell-box metal-spheres; do "$tyndall" convert $scene -o scenes/$scene.json; done
export PATH=$PWD/bin:$PATH TYNDALL_ASSETS=$source_root/assets
expect 0 sh -e step1.sh
same 'renders' 'cornell-box.png metal-spheres.png' "$(ls renders | xargs)"
expect 0 "$tyndall" compare renders --baseline tests/pictures --update # what the page says is done once
expect 0 sh -e step2.sh
[ -s report.html ] && grep -q '<testsuite' junit.xml || fail 'no reports'

# A scene that changes fails the job, and the reports are there.
rm -r renders report.html junit.xml
"$tyndall" convert cornell-box --set /background='[1,0,0]' --set /camera/vfov=60 -o scenes/cornell-box.json
expect 0 sh -e step1.sh
expect 1 sh -e step2.sh
[ -s report.html ] && grep -q '<failure' junit.xml || fail 'no reports of the failure'
finish
