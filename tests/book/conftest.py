import subprocess

import pytest
from program import wait_until
from readers import has_guard


@pytest.fixture(autouse=True)
def folder(tmp_path, tmp_path_factory, monkeypatch):
    """Each test works in an empty folder; nothing stays in that of temporary files, nor a process that runs there."""
    if not has_guard():
        pytest.skip("this system has no guard for programs")
    temporary = tmp_path_factory.mktemp("temporary")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TMPDIR", str(temporary))
    yield
    assert not list(tmp_path.rglob("*.tmp-*")) + list(temporary.iterdir()), "left behind"
    wait_until(lambda: subprocess.run(["pgrep", "-f", temporary]).returncode == 1, 1)
