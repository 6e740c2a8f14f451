import program
import pytest


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Each test works in an empty folder, without a display; nothing that was only half written may stay there."""
    monkeypatch.chdir(tmp_path)
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    yield
    assert not list(tmp_path.rglob("*.tmp-*")), "left behind"


@pytest.fixture
def exr():
    if not program.HAS_EXR:
        pytest.skip("this build reads and writes no EXR")
