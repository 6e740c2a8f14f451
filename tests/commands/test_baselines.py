"""compare --baseline: which pictures are compared with which, what is kept of them, and the reports."""

import base64
import os
import pathlib
import re
import shutil
import xml.etree.ElementTree

from program import load, pfm, read, run, write
from well_formed import well_formed

GREY, OTHER = (16, 8, 0.5, 0.5, 0.5), (16, 8, 0.9, 0.1, 0.5)
REPORTS = "--report report.html --junit junit.xml"


def reported():
    """The text of the page, the suite of JUnit, and the pictures of the JSON by their names."""
    well_formed("report.html", "junit.xml", "report.json")
    pictures = {picture["name"]: picture for picture in load("report.json")["pictures"]}
    return read("report.html").decode(), xml.etree.ElementTree.parse("junit.xml").getroot(), pictures


def test_kept_pictures_and_reports():
    """Tolerances stay until others are given; there is a line for each failure, whatever it is."""
    odd = "a & <b>.pfm"
    pfm(f"new/{odd}", *GREY)
    run("render cornell-box --size 32x18 --spp 4 -q -o new/box.png")
    assert run("compare new/box.png --baseline base --update --max-flip 0.05 --max-rmse 0.5") == "box.png  kept\n"
    run(["compare", f"new/{odd}", "new/box.png", "--baseline", "base", "--update"])
    assert load("base/tolerances.json") == {odd: {"max_flip": 0.02}, "box.png": {"max_rmse": 0.5, "max_flip": 0.05}}
    assert read("new/box.png") == read("base/box.png")
    assert len(re.findall("^ok ", run("compare new --baseline base"), re.M)) == 2

    for name in "base/gone.png", "base/broken.png", "new/fresh.png":
        shutil.copy("base/box.png", name)
    write("new/broken.png", "no picture\n")
    pfm(f"new/{odd}", 8, 8, 0.5, 0.5, 0.5)
    run("render cornell-smoke --size 32x18 --spp 4 -q -o new/box.png", loud=True)
    run(f"compare new --baseline base {REPORTS}", 1, re.compile(r"\A(tyndall: .*\n){5}\Z"), *[
        re.compile(f"^tyndall: {line}", re.M) for line in (
            "box.png: FLIP is .*, expected at most 0.05$", "a & <b>.pfm: .*found 8x8 pixels, expected 16x8",
            "broken.png: ",
            "gone.png: the baseline has it, and it was not rendered; delete it there if that is meant$",
            "fresh.png: the baseline lacks it; --update keeps it$")])
    page, suite, pictures = reported()
    assert (suite.get("tests"), suite.get("failures")) == ("5", "5")
    assert {case.get("name") for case in suite} == {"box.png", odd, "gone.png", "fresh.png", "broken.png"}
    assert all(case.find("failure").get("message") for case in suite)
    images = re.findall(r'src="data:image/png;base64,([^"]+)"', page)
    assert len(images) == 3 and all(base64.b64decode(i, validate=True).startswith(b"\x89PNG") for i in images)
    assert not re.search(r'(src|href)="(?!data:|#p)', page), "the page needs other files"
    assert "a &amp; &lt;b>.pfm" in page and "0 of 5 pictures" in page and page.count('<tr class="bad"><th><a href') == 5
    assert "<code>tyndall render &#39;new/box.png&#39; -o &#39;box-again.png&#39;</code>" in page
    box = pictures.pop("box.png")
    assert not box["passed"] and box["failures"][0].startswith("FLIP is")
    assert box["measured"]["flip"] > 0.05 and box["limits"] == {"flip": 0.05, "rmse": 0.5}
    assert set(box["measured"]) >= {"relmse", "psnr"}
    assert len(pictures) == 4 and all(p["failures"] and not p["measured"] for p in pictures.values())
    # Some pictures only: the others of the baseline are not missed. Other limits for once.
    run("compare base/gone.png --baseline base")
    run("compare new/box.png --baseline base --max-flip 1")


def test_nothing_to_compare():
    """It is no success. What is left out is said."""
    os.makedirs("none")
    os.makedirs("deep/er/still")
    write("texts/notes.txt", "text\n")
    for folder, baseline in ("none", "none"), ("texts", "none"), ("deep", "none"), ("deep", "deep"):
        run(f"compare {folder} --baseline {baseline} {REPORTS}", 1,
            f"tyndall: no picture: nothing was compared: there is no picture in {folder} ",
            re.compile("texts: left out, as their names end in none of .png .*: notes.txt\n" * (folder == "texts")))
        page, suite, _ = reported()
        assert (suite.get("tests"), suite.get("failures")) == ("1", "1") and "nothing was compared" in page


def test_folders():
    """Those within the folder are gone through."""
    names = ["a.pfm", "sub/b.pfm", "sub/deeper/c.pfm"]
    for name in names:
        pfm(f"r/{name}", *GREY)
        pfm(f"k/{name}", *GREY)
    assert [line.split()[:2] for line in run("compare r --baseline k").splitlines()] == [["ok", name] for name in names]
    pfm("r/sub/b.pfm", *OTHER)
    run(f"compare r --baseline k {REPORTS}", 1, "tyndall: sub/b.pfm: FLIP is")
    page, suite, _ = reported()
    assert "<h2>sub/b.pfm " in page and [case.get("name") for case in suite] == names
    run("compare r --baseline k --update --max-flip 1")
    run("compare r --baseline k")
    assert read("r/sub/b.pfm") == read("k/sub/b.pfm") and load("k/tolerances.json")["sub/b.pfm"] == {"max_flip": 1}
    os.remove("r/sub/deeper/c.pfm")
    pfm("r/new/d.pfm", *GREY)
    run("compare r --baseline k", 1, "sub/deeper/c.pfm: the baseline has it, and it was not rendered",
        "new/d.pfm: the baseline lacks it")
    run("compare r --baseline k --update", 0, "deeper/c.pfm: not rendered this time; the baseline keeps what it has")
    assert read("k/sub/deeper/c.pfm") and read("k/new/d.pfm")
    # What cannot be written is found before the first picture is copied.
    os.remove("k/sub/b.pfm")
    os.mkdir("k/sub/b.pfm")
    pfm("r/a.pfm", *OTHER)
    run("compare r --baseline k --update --max-flip 0.5", 3, "k/sub/b.pfm: cannot write")


def test_links():
    """To a folder elsewhere, in a circle, to themselves, to nothing."""
    for name in "elsewhere/e.pfm", "r/sub/a.pfm", "k/sub/a.pfm", "k/gone.pfm":
        pfm(name, *GREY)
    for link in "linked ../elsewhere", "sub/up ..", "here .", "self self", "gone.pfm gone":
        os.symlink(link.split()[1], f"r/{link.split()[0]}")
    run("compare r --baseline k", 1, "linked/e.pfm: the baseline lacks it",
        "r: left out, as links to folders around them: here, sub/up\n",
        re.compile("r: left out, as their names end in none of .*: self$", re.M),
        re.compile("gone.pfm: .*r/gone.pfm: cannot read"), by=["timeout", "60"])


def test_one_within_the_other():
    """A baseline within the folder is not compared with itself, nor the folder within the baseline missed in it."""
    for name in "r/a.pfm", "r/kept/a.pfm", "k/a.pfm", "k/new/a.pfm":
        pfm(name, *GREY)
    for command in "compare r --baseline r/kept", "compare k/new --baseline k":
        assert run(command).count("\n") == 1


def test_kinds_of_files():
    """Pictures of all kinds that can be read; what is no file fails and is not waited for."""
    for name in "k/a.pfm", "k/pipe.pfm", "r/a.pfm":
        pfm(name, *GREY)
    run("render cornell-box --size 16x8 --spp 1 -q -o k/box.PNG")
    for name in "r/box.PNG", "k/box.jpg", "r/box.jpg":
        shutil.copy("k/box.PNG", name)
    os.mkfifo("r/pipe.pfm")
    printed = run("compare r --baseline k", 1, re.compile("pipe.pfm: .*not an ordinary file"), by=["timeout", "20"])
    assert len(re.findall("^ok ", printed, re.M)) == 3
    if os.getuid():
        os.mkdir("r/closed", 0)
        run("compare r --baseline k", 3)
        pathlib.Path("r/closed").chmod(0o755)


def test_gamma2():
    """How PPM files are read: here RMSE is 0.089 by sRGB's curve, and 0.098 by that of the books."""
    write("kept/a.ppm", b"P6 1 1 255\n" + bytes([128] * 3))
    write("a.ppm", b"P6 1 1 255\n" + bytes([100] * 3))
    run("compare a.ppm --baseline kept --max-rmse 0.09")
    run("compare a.ppm --baseline kept --max-rmse 0.09 --gamma2 --report report.html", 1, "RMSE is 0.098")
