"""Pictures in tests, without tolerances: a picture fails where it differs from the kept one by more than noise.

In conftest.py:  pytest_plugins = ["tyndall.pytest_plugin"]

    def test_cover(tyndall_picture):
        tyndall_picture("cover", tyndall.scene("cover").render(spp=64))

Kept pictures are EXR files in the folder "baselines" beside the test. Where there is none yet, and with
TYNDALL_UPDATE=1, the picture is kept and the test passes.
"""

import os
import pathlib

import pytest

import tyndall


@pytest.fixture
def tyndall_picture(request):
    """A function (name, picture, sigmas=4): fails if the picture differs from the kept one by more than its noise.

    Blocks of 16 x 16 pixels are compared by their differences in standard errors, which both films know. sigmas: how
    many standard deviations their mean square may be above what noise gives.
    """
    folder = pathlib.Path(request.path).parent / "baselines"

    def check(name, picture, sigmas=4):
        if not isinstance(picture, tyndall.Picture):
            raise tyndall.Error(f"{name}: found {type(picture).__name__}, expected a tyndall.Picture, which knows its noise")
        file = folder / f"{name}.exr"
        if os.environ.get("TYNDALL_UPDATE") or not file.exists():
            folder.mkdir(exist_ok=True)
            picture.film.save(file)
            return None
        kept = tyndall.Film.load(file)
        found = tyndall.compare(picture, kept)
        if not found.blocks:
            raise tyndall.Error(f"{name}: found fewer than 2 samples a pixel, expected as many as noise needs to be known")
        limit = 1 + (found.block_limit - 1) * sigmas / 4
        if not found.block_score <= limit or found.worst_z == float("inf"):
            seen = file.with_suffix(".seen.exr")
            picture.film.save(seen)
            pytest.fail(f"{name}: the mean square of {found.blocks} blocks' differences is {found.block_score:.3g} "
                        f"squared standard errors, expected at most {limit:.3g}; the picture is in {seen}", pytrace=False)
        return found

    return check
