"""Memory that is known before it is taken, charts, and all of tyndall verify."""

import os
import re
import subprocess
import xml.dom.minidom

import pytest
from program import PROGRAM, instruction_sets, read, run

LIMITED = ["bash", "-c", 'ulimit -v 120000; exec "$0" "$@"']  # kB of address space, too few for these renders
BOX = "render cornell-box -q --size 1200x750"


@pytest.mark.skipif(bool(subprocess.run([*LIMITED, PROGRAM, "-V"], capture_output=True).returncode),
                    reason="sanitizers need more memory")
@pytest.mark.parametrize("command", [
    "render quads -q --size 1200x750 --spp 1 -o m.pfm", f"{BOX} --spp 1 -o m.pfm", f"{BOX} --spp 1 -o m.png",
    f"{BOX} --spp 1 -o m.ppm", f"{BOX} --spp 1 -o m.hdr -o m.pfm", f"{BOX} --spp 2 -o m.pfm --denoise",
    "render cornell-box -q --size 2400x750 --region 0,0,1200,750 --spp 1 -o m.pfm", f"{BOX} --spp 1 -o m.exr",
    "render quads -q --size 1200x750 --spp 1 -o m.exr --exr-film no", f"{BOX} --spp 2 -o m.exr --denoise",
    f"{BOX} --spp 1 -o - --format exr", "merge p0.exr p2.exr -o m.exr", "merge p0.exr p2.exr -o m.png --denoise",
    "denoise p0.exr -o m.PNG"])
def test_memory(command, request):
    """What does not fit is refused before the first sample, with the bytes that it takes, to a tenth."""
    if "exr" in command:
        request.getfixturevalue("exr")
    for name, samples in ("p0.exr", "0:2"), ("p2.exr", "2:3"):
        if name in command:
            run(f"{BOX} --samples {samples} -o {name}", loud=True)
    said = float(re.search(r"takes (\d+) bytes", run(command, 2, "ulimit -v", "bytes", by=LIMITED))[1])
    _, status, used = os.wait4(subprocess.Popen([PROGRAM, *command.split()], stdout=subprocess.DEVNULL).pid, 0)
    took = 1024 * used.ru_maxrss
    assert status == 0 and abs(said / took - 1) < 0.1, f"said {said}, took {took}"


def test_chart():
    run("chart cornell-box --size 32x32 --budget 0.6 -q -o box.svg", out=re.compile("^the books' method", re.M))
    assert read("box.svg").startswith(b"<svg") and xml.dom.minidom.parse("box.svg")
    assert read("box.csv").splitlines()[0] == b"method,spp,seconds,relmse"
    run("chart cornell-box -q -o nowhere/a.svg", 3, "nowhere")


@pytest.mark.parametrize("reference, seen", [
    ("--reference reference.pfm", "direct light (floor 0"), ("", "direct light (bias 0")])
def test_chart_of_methods(reference, seen):
    """max-depth 1 is biased, and that is seen, also against a file."""
    if reference:
        run("render cornell-box --size 32x32 --spp 4096 --sampler random --seed 5 -q -o reference.pfm")
        run(f"chart cornell-box --size 16x16 -q -o a.svg {reference}", 2, "--reference", "32x32", "16x16")
    run(f"chart cornell-box --size 32x32 --budget 2 -q -o two.svg {reference} --method whole= "
        "--method 'direct light=--max-depth 1'")
    assert {line.split(",")[0] for line in read("two.csv").decode().splitlines()} == {"method", "whole", "direct light"}
    chart = read("two.svg").decode()
    assert seen in chart and "whole (bias" not in chart


@pytest.mark.parametrize("options", [
    *[f"--isa {isa}" for isa in instruction_sets()],
    *[f"--integrator {integrator} --sampler random --seed 1000000" for integrator in ("path", "nee", "mis")],
    *[f"--integrator {integrator} --seed 2000000" for integrator in ("path", "nee")]])
def test_verify(options):
    run(f"verify -q {options}", loud=True)
