"""render --replay: one path, in words and to the last bit."""

import re
import struct

import pytest
from program import read, run


@pytest.mark.parametrize("x, y, sample", [(3, 4, 0), (20, 11, 1), (31, 23, 6)])
@pytest.mark.parametrize("scene", ["showroom", "cornell-smoke", "next-week"])
def test_last_line_is_what_the_scalar_kernel_renders(scene, x, y, sample):
    lines = run(f"render {scene} --size 32x24 --replay {x},{y},{sample}").splitlines()
    one = f"--region {x},{y},{x + 1},{y + 1} --samples {sample}:{sample + 1}"
    run(f"render {scene} --size 32x24 {one} --isa scalar -q -o one.pfm")
    assert lines[0] == "0 camera" and lines[-1].startswith("sample ")
    assert struct.pack("<3f", *map(float, lines[-1].split()[1:])) == read("one.pfm")[-12:]
    assert any(line.startswith("    throughput") for line in lines)


@pytest.mark.parametrize("command, expected", [
    ("cornell-box --replay 16,4,0 --set /camera/look_from=[278,278,-800]", "^    point       278 278 -800$"),
    ("cornell-box --replay 16,4,0 --set /camera/look_from=[278,278,-800]", r"^1 after [0-9.]+ meets .* \(white\), "),
    ("cornell-box --max-depth 0 --replay 16,12,0", "is cut at max_depth"),
    ("stress-caustic-shell --replay 10,20,1", "^    by chains   [0-9]"),
    ("stress-caustic-shell --replay 10,20,1 --caustics scatter", r"\A(?!(.|\n)*by chains)"),
])
def test_words(command, expected):
    """What is met is named as in the file; places are the scene's own; light that chains found is said to be theirs."""
    run(f"render {command} --size 32x24", out=re.compile(expected, re.M))
