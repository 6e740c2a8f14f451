"""Pictures in tests, without tolerances: a picture fails where it differs from the kept one by more than noise.

In conftest.py:  pytest_plugins = ["tyndall.pytest_plugin"]

    def test_cover(tyndall_picture):
        tyndall_picture("cover", tyndall.scene("cover").render(spp=64))

Kept pictures are EXR files in the folder "baselines" beside the test, with folders of their own where names have a "/".
Where there is none yet, and with TYNDALL_UPDATE=1, the picture is kept and the test passes. In continuous integration
(CI is set) a missing one fails instead: what is kept there is gone with the machine.
"""

import os
import pathlib

import pytest

import tyndall

YES, NO = ("1", "yes", "true", "on"), ("0", "no", "false", "off", "")


def is_on(variable):
    """Whether this switch of the environment is on. Raises tyndall.Error where its value is neither yes nor no."""
    value = os.environ.get(variable, "")
    if value.lower() not in YES + NO:
        raise tyndall.Error(f'{variable}: found "{value}", expected 1, yes, true or on, or 0, no, false, off or nothing')
    return value.lower() in YES


@pytest.fixture
def tyndall_picture(request):
    """A function (name, picture, sigmas=4): fails if the picture differs from the kept one by more than its noise.

    It is the test of "tyndall compare --max-z": means, blocks of 16 x 16 pixels and outliers. sigmas: how many standard
    errors these may differ by, corrected for the number of tests: noise alone gives more than 4 at most once in 16,000.
    """
    folder = pathlib.Path(request.path).parent / "baselines"
    update = is_on("TYNDALL_UPDATE")
    in_ci = os.environ.get("CI", "").lower() not in NO

    def check(name, picture, sigmas=4):
        if not isinstance(picture, tyndall.Picture):
            raise tyndall.Error(f"{name}: found {type(picture).__name__}, expected a tyndall.Picture, which knows its noise")
        file = folder / f"{name}.exr"
        if not update and in_ci and not file.exists():
            pytest.fail(f"{name}: found no {file}, expected a kept picture, as CI is set; TYNDALL_UPDATE=1 keeps one",
                        pytrace=False)
        if update or not file.exists():
            file.parent.mkdir(parents=True, exist_ok=True)
            picture.film.save(file)
            return None
        kept = tyndall.Film.load(file)
        found = tyndall.compare(picture, kept)
        if not found.blocks:
            raise tyndall.Error(f"{name}: found fewer than 2 samples a pixel, expected as many as noise needs to be known")
        if found.enough_spp > 0:
            pytest.fail(f"{name}: too few samples to tell: no block with light has enough; about {found.enough_spp:.0f} a "
                        "pixel would do", pytrace=False)
        if not found.z <= sigmas:
            seen = file.with_suffix(".seen.exr")
            picture.film.save(seen)
            pytest.fail(f"{name}: differs from the kept picture by {found.z:.3g} standard errors, expected at most "
                        f"{sigmas:g}; the picture is in {seen}: tyndall compare {seen} {file} --max-z {sigmas:g}",
                        pytrace=False)
        return found

    return check
