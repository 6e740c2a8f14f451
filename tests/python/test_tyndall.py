"""The Python module as its users see it. TYNDALL_PROGRAM names the program, whose pictures must have the same bits."""

import copy
import json
import math
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy
import pytest

import tyndall

program = os.environ["TYNDALL_PROGRAM"]


def small(name):
    scene = tyndall.scene(name)
    scene["/image/width"], scene["/image/height"] = 48, 32
    return scene


def test_bits_are_those_of_the_command(tmp_path):
    names = tyndall.built_in()
    assert len(names) >= 53
    for name in names if "TYNDALL_THOROUGH" in os.environ else names[::6]:  # library_test.cpp has them all
        stats = subprocess.run([program, "render", name, "--size", "48x32", "--spp", "2", "-q", "--stats", "-", "-o",
                                str(tmp_path / "x.pfm")], capture_output=True, text=True, check=True).stdout
        assert small(name).render(spp=2).hash == json.loads(stats)["image_hash"], name


def test_array_is_a_view_of_the_picture():
    picture = small("cover").render(spp=2)
    array = picture.array
    assert array.shape == (32, 48, 3) and array.dtype == numpy.float32 and array.flags.c_contiguous
    assert not array.flags.writeable and not array.flags.owndata
    assert array.__array_interface__["data"] == picture.array.__array_interface__["data"]
    kept = array.sum()
    del picture
    assert array.sum() == kept  # the array keeps the picture alive
    picture = small("cover").render(spp=4, clean=True)
    assert picture.clean.shape == (32, 48, 3) and picture.error_map.shape == (32, 48)
    albedo, normal, depth = picture.features
    assert albedo.shape == normal.shape == (32, 48, 3) and depth.shape == (32, 48)
    assert 0 < picture.error < math.inf and len(picture.clean_hash) == 16
    assert numpy.asarray(picture).shape == (32, 48, 3)


def test_scenes_are_mappings():
    scene = small("metal-spheres")
    assert scene["/camera/defocus_angle"] == 0
    scene["/camera/vfov"] = numpy.float64(30)
    assert scene["/camera/vfov"] == 30
    names = list(scene.materials)
    assert names
    scene.materials["mirror"] = {"type": "metal", "albedo": numpy.ones(3), "fuzz": 0.25}
    scene.materials["mirror"]["fuzz"] = 0.5
    assert scene["/materials/mirror/fuzz"] == 0.5 and scene.materials["mirror"]["fuzz"] == 0.5
    assert "mirror" in scene.materials and len(scene.materials) == len(names) + 1
    count = len(scene.objects)
    scene.objects.append({"type": "sphere", "center": [0, 1, 0], "radius": 0.2, "material": "mirror", "name": "small"})
    assert len(scene.objects) == count + 1 and scene.objects["small"]["radius"] == 0.2
    scene.objects[-1]["radius"] = 0.3
    assert scene.objects["small"]["radius"] == 0.3
    copy = scene.copy()
    del scene.objects["small"]
    del scene.materials["mirror"]
    assert "mirror" not in scene.materials and "mirror" in copy.materials
    assert tyndall.scene(json.loads(copy.json())) == copy


def test_progressive_pictures_end_as_one_render():
    pictures = list(small("cornell-box").progressive(spp=8))
    assert [picture.spp for picture in pictures] == [1, 2, 4, 8]
    assert pictures[-1].hash == small("cornell-box").render(spp=8).hash
    begin = time.monotonic()
    assert len(list(small("cover").progressive(seconds=0.3))) >= 2
    assert time.monotonic() - begin < 5
    assert small("cornell-box").render(spp=1, region=(1, 2, 7, 5)).array.shape == (3, 6, 3)


def test_films_are_saved_and_merged(tmp_path):
    scene = small("cornell-box")
    whole = scene.render(spp=6)
    first, rest = scene.render(spp=2).film, scene.render(spp=4, first_sample=2).film
    first.save(tmp_path / "first.exr")
    again = tyndall.Film.load(tmp_path / "first.exr")
    assert tyndall.merge([rest, again]).hash == whole.hash
    assert scene.render(spp=6, film=again).hash == whole.hash
    assert again.picture.spp == 2 and again.scene.width == 48
    for name in ("p.png", "p.exr", "p.ppm", "p.pfm", "p.hdr"):
        whole.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 100
    assert tyndall.scene(tmp_path / "p.png").render(spp=6).hash == whole.hash


def test_compare():
    scene = small("cornell-box")
    a = scene.render(spp=32)
    scene["/render/seed"] = 5
    b = scene.render(spp=32)
    found = tyndall.compare(a, b)
    assert found.only_noise and found.blocks > 0 and found.relmse > 0
    assert tyndall.compare(a.array, b.array).relmse == found.relmse
    assert tyndall.compare(a, a).mse == 0
    assert found.mean_reference == tyndall.compare(b, a).mean_image != found.mean_image
    assert found._fields[:5] == ("mse", "rmse", "relmse", "psnr", "flip")


def test_notebooks_show_pictures():
    picture = small("cover").render(spp=1)
    assert picture._repr_png_().startswith(b"\x89PNG")
    html = picture._repr_html_()
    assert "48 x 32, 1 samples a pixel" in html and "data:image/png;base64," in html


def test_other_threads_run_meanwhile():
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count, daemon=True)
    thread.start()
    small("next-week").render(time=0.5)
    done.set()
    thread.join()
    assert counted[0] > 50


def test_two_threads_render_at_once_and_a_child_after_fork():
    expected = small("cornell-smoke").render(spp=4).hash
    seen = []
    threads = [threading.Thread(target=lambda: seen.append(small("cornell-smoke").render(spp=4).hash)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert seen == [expected, expected]
    child = os.fork()
    if child == 0:
        os._exit(0 if small("cornell-smoke").render(spp=4).hash == expected else 1)
    assert os.waitpid(child, 0)[1] == 0


def test_progress_stops_and_its_errors_come_through():
    calls = []
    picture = small("cover").render(time=100, progress=lambda now: calls.append(now.spp) or len(calls) < 3)
    assert picture.stopped and len(calls) == 3

    def fails(now):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        small("cover").render(time=100, progress=fails)

    class Mine(tyndall.Error):
        pass

    def fails_by(error):
        raise error

    for error in (Mine("x"), KeyboardInterrupt(), SystemExit(3)):
        with pytest.raises(type(error)):
            small("cover").render(time=100, progress=lambda now: fails_by(error))


def test_progress_stops_by_what_is_false_but_none():
    for answer in (False, 0, numpy.bool_(False), numpy.float64(0), []):
        begin = time.monotonic()
        assert small("cover").render(time=100, progress=lambda now: answer).stopped, answer
        assert time.monotonic() - begin < 20
    for answer in (None, True, numpy.bool_(True), 1, "x"):
        assert not small("cover").render(spp=2, progress=lambda now: answer).stopped, answer
    with pytest.raises(ValueError, match="ambiguous"):
        small("cover").render(time=100, progress=lambda now: numpy.zeros(2))


def test_scenes_are_copied_and_pickled(tmp_path, monkeypatch):
    for scene in (small("cover"), tyndall.scene("earth"), tyndall.scene()):
        for again in (copy.deepcopy(scene), copy.copy(scene), pickle.loads(pickle.dumps(scene))):
            assert again == scene and again is not scene
            again["/camera/vfov"] = 33
            assert again != scene
        assert copy.deepcopy({"a": [scene, scene]})["a"][0] == scene
    folder = tmp_path / "bälle"
    folder.mkdir()
    (folder / "t.ppm").write_bytes(b"P6 1 1 255\n\xff\0\0")
    scene = {"textures": {"t": {"type": "image", "file": "t.ppm"}}, "materials": {"m": {"type": "lambertian", "albedo": "t"}},
             "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"}]}
    (folder / "s.json").write_text(json.dumps({"tyndall": 1, **scene}))
    scene = tyndall.scene(os.path.relpath(folder / "s.json"))
    text = pickle.dumps(scene)
    monkeypatch.chdir(tmp_path)
    assert pickle.loads(text) == scene


def test_ctrl_c_stops_a_render():
    code = ("import tyndall\nprint('ready', flush=True)\n"
            "try:\n    tyndall.scene('next-week').render(time=100)\n"
            "except KeyboardInterrupt:\n    print('interrupted', flush=True)\n")
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.5)
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted\n"
        assert time.monotonic() - begin < 2


def test_import_is_quick():
    def seconds(line):
        times = []
        for _ in range(5):
            begin = time.perf_counter()
            subprocess.run([sys.executable, "-c", line], check=True)
            times.append(time.perf_counter() - begin)
        return min(times)

    assert seconds("import numpy, tyndall") - seconds("import numpy") < 0.05


def test_errors_are_the_commands_sentences():
    scene = small("cover")
    with pytest.raises(tyndall.Error) as caught:
        scene["/camera/vfov"] = 200
    assert caught.value.place == "/camera/vfov" and caught.value.found == "200"
    assert str(caught.value).startswith("cover: /camera/vfov: found 200, expected ")
    with pytest.raises(tyndall.Error) as caught:
        tyndall.scene("no-such-scene")
    assert caught.value.file == "no-such-scene"


class Odd:
    """Nothing that anything expects."""


WRONG = [None, Odd(), object, b"\xff", "\ud800", "a\0b", -1, 1.5, math.nan, math.inf, -math.inf, 10**40, 1j, [], [1], [[]],
         {}, {1: 2}, {"a": Odd()}, (), "", "x", True, numpy.zeros(0), numpy.zeros((2, 2)), numpy.array(["a"]), lambda: 1]


def wrong_calls():
    recursive = []
    recursive.append(recursive)
    scene = small("metal-spheres")
    picture = scene.render(spp=1)
    for wrong in WRONG + [recursive]:
        options = ["spp", "time", "target_error", "threads", "region", "first_sample", "film", "isa"]
        if not callable(wrong):  # a function may fail by itself
            options.append("progress")
        for option in options:
            yield f"render({option}={ascii(wrong)[:40]})", lambda o=option, w=wrong: scene.render(**{"spp": 1, o: w})
        yield f"set {ascii(wrong)[:40]}", lambda w=wrong: scene.__setitem__("/camera/look_from", w)
        yield f"pointer {ascii(wrong)[:40]}", lambda w=wrong: scene[w]
        yield f"scene({ascii(wrong)[:40]})", lambda w=wrong: tyndall.scene(w)
        yield f"append {ascii(wrong)[:40]}", lambda w=wrong: scene.objects.append(w)
        yield f"material {ascii(wrong)[:40]}", lambda w=wrong: scene.materials.__setitem__("m", w)
        yield f"save {ascii(wrong)[:40]}", lambda w=wrong: picture.save(w)
        yield f"load {ascii(wrong)[:40]}", lambda w=wrong: tyndall.Film.load(w)
        yield f"compare {ascii(wrong)[:40]}", lambda w=wrong: tyndall.compare(picture, w)
        yield f"merge {ascii(wrong)[:40]}", lambda w=wrong: tyndall.merge([w])


# Some of what is wrong in one place is right in another; such calls may work, but do nothing else.
def test_wrong_calls_raise_errors():
    refused = 0
    for what, call in wrong_calls():
        try:
            call()
        except tyndall.Error as error:
            refused += 1
            assert "found" in str(error) and "expected" in str(error) or ": " in str(error), what
            assert "\n" not in str(error), what
        except Exception as other:
            raise AssertionError(f"{what}: {type(other).__name__}: {other}") from other
    assert refused >= 200


def test_deleted_films_stay_whole():
    scene = small("cornell-box")
    film = scene.render(spp=2).film
    expected = film.hash
    picture = film.picture
    del film, scene
    assert picture.hash == expected and picture.film.hash == expected
