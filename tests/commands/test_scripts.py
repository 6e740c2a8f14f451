"""Scripts beside the program: ./run's switches, and the job for GitHub that app/cli/README.md shows."""

import os
import re
import shutil
import subprocess

import pytest
from program import PROGRAM, ROOT, read, run


def test_switches():
    """Variables of the environment that say yes or no, as scripts read them: in any case of letters, nothing else."""
    def asked(question, **variables):
        environment = {key: value for key, value in os.environ.items() if key != "CI"} | variables
        done = subprocess.run(["bash", "-c", f". '{ROOT}/third_party/switches.sh'; {question}"], env=environment,
                              capture_output=True, text=True)
        return done.returncode, done.stderr
    for yes in ("1", "yes", "true", "on", "YES", "On"):
        assert asked("is_on TYNDALL_SOME", TYNDALL_SOME=yes)[0] == 0
    for no in ("", "0", "no", "false", "off", "NO", "False"):
        assert asked("is_on TYNDALL_SOME", TYNDALL_SOME=no)[0] == asked("in_ci", CI=no)[0] == 1
    assert asked("is_on TYNDALL_SOME || in_ci")[0] == 1 and asked("in_ci", CI="Jenkins")[0] == 0
    for neither in ("2", "maybe", " "):
        code, said = asked("is_on TYNDALL_SOME; exit 0", TYNDALL_SOME=neither)
        assert code == 2 and f'TYNDALL_SOME: found "{neither}", expected 1, yes, true or on, or 0, no' in said
    code, said = asked(f"'{ROOT}/run' --help", TYNDALL_SKIP_PACKAGES="perhaps")
    assert code == 2 and said.startswith('TYNDALL_SKIP_PACKAGES: found "perhaps", expected 1')


def test_workflow():
    """It is YAML, and its steps do what the page says of them, run as GitHub runs them in a container, by "sh -e". The
    step that installs the package is left to app/package_nightly.sh."""
    yaml = pytest.importorskip("yaml")
    block = re.search(r"```yaml\n(.*?)```", (ROOT / "app/cli/README.md").read_text(), re.S)[1]
    job = yaml.safe_load(block)["jobs"]["pictures"]
    assert set(job) == {"runs-on", "container", "steps"}
    installs, renders, compares = (step["run"] for step in job["steps"] if "run" in step)
    assert "apt-get install" in installs
    for folder in ("scenes", "bin", "tests"):
        os.mkdir(folder)
    os.symlink(PROGRAM, "bin/tyndall")

    def step(script, code=0):
        path = {"PATH": f"{os.getcwd()}/bin:{os.environ['PATH']}"}
        assert subprocess.run(["sh", "-e", "-c", script], env=os.environ | path).returncode == code
    for scene in ("cornell-box", "metal-spheres"):
        run(f"convert {scene} -o scenes/{scene}.json")
    step(renders)
    assert sorted(os.listdir("renders")) == ["cornell-box.png", "metal-spheres.png"]
    run("compare renders --baseline tests/pictures --update")  # what the page says is done once
    step(compares)
    assert read("report.html") and b"<testsuite" in read("junit.xml")
    # A scene that changes fails the job, and the reports are there.
    shutil.rmtree("renders")
    os.remove("report.html")
    run("convert cornell-box --set /background=[1,0,0] --set /camera/vfov=60 -o scenes/cornell-box.json")
    step(renders)
    step(compares, 1)
    assert read("report.html") and b"<failure" in read("junit.xml")
