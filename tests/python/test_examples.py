"""The notebook's cells and the example of a repository with kept pictures, as users run them."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

import tyndall

assets = pathlib.Path(os.environ["TYNDALL_ASSETS"])


def test_notebook_runs(capsys):
    cells = json.loads((assets / "notebooks/first-look.ipynb").read_text())["cells"]
    names = {}
    for cell in cells:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), "first-look.ipynb", "exec"), names)
    said = capsys.readouterr().out
    assert "another seed: True" in said and "another fuzz: False" in said


def run_pytest(folder, **variables):
    return subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(folder)],
                          env=dict(os.environ, **variables), capture_output=True, text=True)


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
