"""compare: two pictures, by their numbers and by their noise, and a picture with a scene. accuracy/error,
app/comparison/pair and app/check/explain have what is found; here is how it is told. What is refused is in refusals."""

import json
import os
import re
import shutil

import pytest
from program import load, pfm, read, run, write
from well_formed import well_formed


def compared(arguments, code=0, *words, **options):
    return json.loads(run(f"compare {arguments} --json", code, *words, **options))


@pytest.fixture
def pair():
    pfm("grey.pfm", 16, 8, 0.5, 0.5, 0.5)
    pfm("red.pfm", 16, 8, 0.6, 0.5, 0.5)


def test_numbers(pair):
    found = compared("red.pfm grey.pfm")
    known = {"mse": 0.01 / 3, "rmse": (0.01 / 3) ** 0.5, "relmse": 0.01 / 0.26 / 3,
             "psnr": 28.870195}  # sRGB of 0.6 and 0.5: 0.797738 and 0.735357
    assert {key: found[key] for key in known} == pytest.approx(known, rel=1e-5)
    assert found["mean_reference"] == [0.5, 0.5, 0.5]
    run("compare red.pfm grey.pfm --heatmap heat.png",
        out=["MSE", "RMSE", "relMSE", "PSNR", "FLIP", "red", "green", "blue"])
    assert read("heat.png")[1:4] == b"PNG"
    equal = compared("grey.pfm grey.pfm --max-rmse 0 --max-relmse 0 --max-flip 0")
    assert equal["psnr"] is None and equal["flip"] == 0
    pfm("broken.pfm", 16, 8, float("nan"), 0.5, 0.5)
    assert compared("broken.pfm grey.pfm", 1)["mse"] is None  # equal to nothing, without a limit


@pytest.mark.parametrize("limit, code", [("rmse 0.058", 0), ("rmse 0.057", 1), ("relmse 0.0128", 1), ("flip 0.001", 1)])
def test_limits(pair, limit, code):
    """Where one is passed, the table is printed all the same."""
    name = re.compile(f"^tyndall: check failed: {limit.split()[0]} is ", re.I)
    run(f"compare red.pfm grey.pfm --max-{limit}", code, *[name] * code, out="RMSE")


def test_parts_and_layers(exr):
    """EXR files are compared by position, over the pixels that both have; so is a region in another format. A layer has
    not the noise of its film."""
    for name, options in ("whole", ""), ("part", "--region 5,3,25,20"):
        run(f"render cornell-box --size 32x24 --spp 2 -q -o {name}.exr -o {name}.pfm {options}")
    run("compare whole.pfm part.exr --max-rmse 0")
    both = "340 that both have, of 340 in the image and 768 in the reference\n"
    run("compare part.exr whole.exr", out=f"pixels   {both}")
    part = compared("part.exr whole.exr --max-rmse 0")
    assert part["width"] == 20 and part["pixels"] == {"compared": 340, "image": 340, "reference": 768}
    assert "both have" not in run("compare whole.exr whole.exr") and "blocks" in compared("whole.exr whole.exr")
    run("compare part.exr --baseline kept --update")
    shutil.move("kept/part.exr", "kept/whole.exr")
    run("compare whole.exr --baseline kept", out=re.compile("ok .*pixels: 340 that both have"))
    run("compare whole.exr:Albedo.R part.exr:Albedo.R --max-rmse 0")
    layer = compared("whole.exr:Albedo whole.exr")
    assert layer["mse"] > 0 and layer["pixels"]["compared"] == 768 and "blocks" not in layer


def test_gamma2():
    """A PPM as the books' programs write it is right where it is read so. What is out of its range is told once."""
    run("render showroom --size 32x18 --spp 4 -q --gamma2 -o books.ppm -o a.pfm")
    run("compare books.ppm a.pfm --gamma2 --max-flip 0.02")
    run("compare books.ppm a.pfm --max-flip 0.02", 1, "FLIP is")
    write("books3.ppm", "P3\n# by hand\n2 1\n255\n256 -1 128\n-2147483648 0 255\n")
    write("same.ppm", b"P6 2 1 255\n\xff\0\x80\0\0\xff")
    run("compare books3.ppm same.ppm --max-rmse 0", 0, "tyndall: books3.ppm: 3 of 6 numbers are outside of 0 to 255")


def test_noise_of_pfm():
    """The difference of 0.01 has an error of 0.05 sqrt(2 / 512) = 0.0031: 3.2 of them, and more with less noise."""
    mean = "tyndall: check failed: the mean of green differs by -0.01 +- 0.0012: "
    for noise, code, words in (0.05, 0, []), (0.02, 1, [mean]):
        for name, green in ("a", 0.5), ("b", 0.51):
            pfm(f"{name}.pfm", 32, 16, 0.5, green, 0.5)
            pfm(f"{name}.error.pfm", 32, 16, noise, noise, noise)
        run("compare a.pfm b.pfm --max-z 4", code, *words)
    for name in "off.pfm", "off.error.pfm":
        pfm(name, 32, 16, 0, 0, 0)
    run("compare off.pfm off.pfm --max-z 4", out="nothing is lit in either")


def test_noise_of_films(exr):
    """Another seed is the same picture, a small change is not, also of a part and without the film. For baselines, too:
    what FLIP calls a failure is noise."""
    for folder in "new", "other":
        os.mkdir(folder)
    for seed, options in enumerate(["-o new/a.exr", "-o other/a.exr", "--exr-film no -o bare.exr",
                                    "--region 20,10,70,50 -o part.exr", "--set /camera/vfov=21 -o changed.exr"]):
        run(f"render cover --size 96x64 --spp 64 -q --seed {seed} {options}")
    noise = compared("other/a.exr new/a.exr --max-z 4")["noise"]
    assert noise["z"] == max(*noise["mean_z"], noise["block_z"], noise["outlier_z"]) < 4 and noise["blocks"] == 24
    assert noise["cannot_tell"] == 0 and all(0 < error < 0.01 for error in noise["error"])
    layer = compared("bare.exr new/a.exr --max-z 4")["noise"]
    assert layer["error"] == pytest.approx(noise["error"], rel=0.1)  # by the layer Variance
    run("compare part.exr new/a.exr --max-z 4")
    for name in "bare.exr", "part.exr":
        run(f"compare {name} changed.exr --max-z 4", 1, re.compile("^tyndall: check failed: .* standard errors"))

    run("compare new --baseline kept --update --max-z 4")
    assert load("kept/tolerances.json") == {"a.exr": {"max_z": 4}}
    reports = "--report report.html --junit junit.xml"
    run("compare other/a.exr --baseline kept --max-flip 0.02", 1, "FLIP is")
    run(f"compare other --baseline kept {reports}", out=re.compile("^ok .*noise: means "))
    assert b"z of the blocks" in read("report.html") and load("report.json")["pictures"][0]["measured"]["block_z"] < 4
    shutil.copy("changed.exr", "other/a.exr")
    run(f"compare other --baseline kept {reports}", 1, "standard errors")
    well_formed("report.html", "junit.xml")
    assert b"standard errors" in read("report.html") and b'failures="1"' in read("junit.xml")


def test_too_few_samples_to_tell(exr):
    """A lamp three times as bright that few paths meet."""
    for name, options in ("lamp", "--seed 1"), ("brighter", "--seed 2 --set /materials/lamp/radiance=[45,45,45]"):
        run("render cornell-box --integrator path --size 32x32 --spp 2 -q --set /camera/vfov=20 "
            f"{options} -o {name}.exr", loud=True)
    run("compare lamp.exr brighter.exr --max-z 4", 1, re.compile(
        "too few samples to tell: no block with light, of 4, has .*; about [0-9]+ a pixel would do"))


def test_scene():
    """In words and JSON, from standard input, and each way in which right pictures are written."""
    run("render metal-spheres --size 64x36 --spp 64 --seed 7 --gamma2 -o right.ppm -o right.png -o right.pfm -q")
    run("convert metal-spheres -o scene.json")
    agrees = re.compile("^check    the pictures agree within the noise", re.M)
    run("compare - scene.json --time 4", 0, re.compile("gamma 2.* fits the scene better"), given=read("right.ppm"),
        out=[agrees, "samples a pixel, as its noise tells; gamma 2\n", re.compile("^RMSE", re.M)])
    run("compare right.png metal-spheres --time 4", out=[agrees, "; sRGB's curve\n"])
    found = compared("right.pfm metal-spheres --time 4 --max-flip 0.2 --max-rmse 0.00001", 1, "check failed: RMSE")
    assert found["verdict"]["agrees"] is True and found["verdict"]["explanation"] is None
    assert not agrees.search(run("compare right.png right.png"))  # though they carry a scene
