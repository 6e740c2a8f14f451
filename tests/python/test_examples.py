"""The notebook's cells and the example of a repository with kept pictures, as users run them."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

import pytest
import tyndall

assets = pathlib.Path(os.environ["TYNDALL_ASSETS"])
slow = pytest.mark.skipif("TYNDALL_THOROUGH" not in os.environ, reason="takes long: ./test --all runs it")


@slow
def test_notebook_runs(capsys):
    cells = json.loads((assets / "notebooks/first-look.ipynb").read_text())["cells"]
    names = {}
    for cell in cells:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), "first-look.ipynb", "exec"), names)
    said = capsys.readouterr().out
    assert "another seed: True" in said and "another fuzz: False" in said


def run_pytest(folder, **variables):
    """Runs the folder's tests with no other switches than these."""
    outside = {name: value for name, value in os.environ.items() if name not in ("CI", "TYNDALL_UPDATE")}
    return subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(folder)],
                          env=outside | variables, capture_output=True, text=True)


def test_kept_pictures(tmp_path):
    folder = tmp_path / "mine"
    shutil.copytree(assets / "examples/pytest", folder)
    first = run_pytest(folder)
    assert first.returncode == 0, first.stdout
    assert (folder / "baselines/glass-ball.exr").exists()
    assert run_pytest(folder).returncode == 0
    test = folder / "test_pictures.py"
    test.write_text(test.read_text().replace("return scene", "scene['/camera/vfov'] = 35\n    return scene"))
    changed = run_pytest(folder)
    assert changed.returncode == 1 and "expected at most" in changed.stdout
    assert run_pytest(folder, TYNDALL_UPDATE="1").returncode == 0
    assert run_pytest(folder).returncode == 0
    assert isinstance(tyndall.Film.load(folder / "baselines/glass-ball.exr").spp, int)


def test_too_few_samples(tmp_path):
    folder = tmp_path / "mine"
    shutil.copytree(assets / "examples/pytest", folder)
    (folder / "test_pictures.py").write_text('''
import tyndall
def test_dim(tyndall_picture):
    scene = tyndall.scene("cornell-box")
    scene["/image/width"] = scene["/image/height"] = 32
    scene["/camera/vfov"], scene["/render/integrator"] = 20, "path"
    tyndall_picture("dim", scene.render(spp=2))
''')
    assert run_pytest(folder).returncode == 0  # it is kept
    few = run_pytest(folder)
    assert few.returncode == 1 and "too few samples to tell" in few.stdout and "would do" in few.stdout


@slow
def test_switches(tmp_path):
    """A switch that says no keeps nothing, CI wants pictures that are there, and names may have folders."""
    folder = tmp_path / "mine"
    shutil.copytree(assets / "examples/pytest", folder)
    test, kept = folder / "test_pictures.py", folder / "baselines/balls/glass-ball.exr"
    test.write_text(test.read_text().replace('"glass-ball"', '"balls/glass-ball"'))
    for on in ("1", "true", "Jenkins"):
        missing = run_pytest(folder, CI=on)
        assert missing.returncode == 1 and "TYNDALL_UPDATE=1 keeps one" in missing.stdout and not kept.exists()
    assert run_pytest(folder, CI="false").returncode == 0 and kept.exists()
    before = kept.read_bytes()
    assert run_pytest(folder, CI="true").returncode == 0
    test.write_text(test.read_text().replace("return scene", "scene['/camera/vfov'] = 35\n    return scene"))
    for off in ("0", "no", "False", "OFF", ""):
        assert run_pytest(folder, TYNDALL_UPDATE=off).returncode == 1
    unclear = run_pytest(folder, TYNDALL_UPDATE="maybe")
    assert unclear.returncode == 1 and 'TYNDALL_UPDATE: found "maybe", expected 1' in unclear.stdout
    assert kept.read_bytes() == before
    assert run_pytest(folder, CI="true", TYNDALL_UPDATE="Yes").returncode == 0 and kept.read_bytes() != before
