#!/usr/bin/env python3
"""False alarms of "tyndall compare --max-z 4" on re-seeded pairs, and how many planted changes it finds.

Usage: noise_pairs.py TYNDALL [--pairs N] [--trials N] [--jobs N] [--scratch FOLDER] [--broken PROGRAM]

It needs Python's standard library and the program alone. Pairs: N pairs of other seeds, over 12 built-in scenes, ten dark ones
(built-in scenes before a black sky), and 8 and 64 samples a pixel. Trials: of each scene and planted change N pairs at 256 samples. --broken: a program that weighs one of
the two ways to a light wrongly, as one more change. Prints a table; exit code 1 if there is a false alarm, or if fewer
than 95 % of the changes above the floor are found.

The floor. A change is tested by how many standard errors the mean of a channel, or of a block, moves. At Z = 4 alarm is given
above 4.6 of them for means (one of 9 tests) and above 6.0 for one of 100 blocks (of 64 degrees of freedom); in 19 of 20 cases noise
takes away less than 1.65. So what moves a mean by 6.2 standard errors at 256 samples, or a block by 7.7, is above the floor.
How far it moves is measured with all trials merged.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SCENES = ["showroom", "metal-spheres", "glass-spheres", "cover", "bouncing-spheres", "checkered-spheres", "quads",
          "simple-light", "cornell-box", "cornell-smoke", "next-week", "stress-caustic-glass"]
DARK = ["stress-bulb", "stress-small-light", "stress-light-in-fog", "stress-light-and-fuzz", "stress-caustic-mirror",
        "stress-caustic-shell", "stress-two-balls", "stress-mirror-wall", "simple-light", "metal-spheres"]
SIZE = {"cornell-box": "144x144", "cornell-smoke": "144x144", "next-week": "144x144"}
MEAN_FLOOR, BLOCK_FLOOR = 6.2, 7.7


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr}")
    return done


def render(program, scene, file, size, *options):
    run([program, "render", str(scene), "-q", "-t", "1", "--size", size, "-o", str(file), *options])


def compare(program, a, b):
    return json.loads(run([program, "compare", str(a), str(b), "--max-z", "4", "--json"]).stdout)["noise"]


def pair(program, folder, scene, number):
    """Two seeds of a scene. Returns the corrected z and the blocks of which nothing can be told."""
    spp = (8, 64)[number // len(SCENES + DARK) % 2]
    sky = ["--set", "/background=[0,0,0]"] if number % len(SCENES + DARK) >= len(SCENES) else []
    files = [folder / f"pair-{number}-{k}.exr" for k in (0, 1)]
    for k, file in enumerate(files):
        render(program, scene, file, SIZE.get(scene, "192x108"), "--spp", str(spp), "--seed", str(2 * number + k + 1),
               *sky)
    found = compare(program, *files)
    for file in files:
        file.unlink()
    return "dark " + scene if sky else scene, spp, found


def colours(materials, key):
    return [m for m in materials.values() if isinstance(m.get(key), list)]


def brighter(scene):
    for material in colours(scene["materials"], "radiance"):
        material["radiance"] = [1.005 * v for v in material["radiance"]]
    sky = scene.get("background", [0, 0, 0])
    if isinstance(sky, list):
        scene["background"] = [1.005 * v for v in sky]
    for key in ("bottom", "top", "up", "down"):
        if isinstance(sky, dict) and key in sky:
            sky[key] = [1.005 * v for v in sky[key]]
    if isinstance(sky, dict) and sky["type"] == "image":
        sky["scale"] = 1.005 * sky.get("scale", 1)
    return True


def wider(scene):
    camera = scene.setdefault("camera", {})
    camera["vfov"] = 1.01 * camera.get("vfov", 90)
    return True


def other_albedo(scene):
    """Of the material that most objects have, or the first."""
    materials = colours({k: m for k, m in scene.get("materials", {}).items() if m["type"] == "lambertian"}, "albedo")
    if materials:
        factor = 1.02 if max(materials[0]["albedo"]) * 1.02 <= 1 else 0.98
        materials[0]["albedo"] = [factor * v for v in materials[0]["albedo"]]
    return bool(materials)


def fuzzier(scene):
    metals = [m for m in scene.get("materials", {}).values() if m["type"] == "metal"]
    if metals:
        fuzz = metals[0].get("fuzz", 0)
        metals[0]["fuzz"] = fuzz + 0.02 if fuzz <= 0.98 else fuzz - 0.02
    return bool(metals)


CHANGES = {"mean by 0.5 %": brighter, "vfov by 1 %": wider, "an albedo by 2 %": other_albedo, "fuzz by 0.02": fuzzier}


def planted(program, changed_program, folder, scene, change, trials):
    """Returns what was found in each trial, and how many standard errors the change is at 256 samples."""
    here = folder / f"{scene}-{change.replace(' ', '_').replace('%', '')}"
    here.mkdir()
    file = here / "changed.json"
    run([program, "convert", scene, "-o", str(file)])
    text = json.loads(file.read_text())
    if change in CHANGES and not CHANGES[change](text):
        return None
    file.write_text(json.dumps(text))
    size, found = SIZE.get(scene, "192x108"), []
    for k in range(trials):
        samples = f"{256 * k}:{256 * k + 256}"
        render(program, scene, here / f"a{k}.exr", size, "--samples", samples, "--seed", "11")
        render(changed_program, file, here / f"b{k}.exr", size, "--samples", samples, "--seed", "12")
        found.append(compare(program, here / f"a{k}.exr", here / f"b{k}.exr")["z"])
    for side in "ab":
        run([program, "merge", *(str(here / f"{side}{k}.exr") for k in range(trials)), "-o", str(here / f"{side}.exr")])
    whole = compare(program, here / "a.exr", here / "b.exr")
    shutil.rmtree(here)
    mean = max(abs(d) / e if e > 0 else 0 for d, e in zip(whole["difference"], whole["error"])) / math.sqrt(trials)
    # The block's score is corrected for the number of tests, whose logarithm the exponent -z²/2 lacks.
    block = math.sqrt(whole["block_z"] ** 2 + 2 * math.log(9 * whole["blocks"])) / math.sqrt(trials)
    return scene, change, found, mean, block if whole["block_z"] > 0 else 0.0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--pairs", type=int, default=1000)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--scratch")
    parser.add_argument("--broken")
    options = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(dir=options.scratch))
    program = os.path.abspath(options.program)
    alarms, worst, good = [], 0.0, True
    unclear = {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        pairs = [pool.submit(pair, program, folder, (SCENES + DARK)[n % len(SCENES + DARK)], n) for n in range(options.pairs)]
        changes = {name: program for name in CHANGES}
        if options.broken:
            changes["light sampling without a weight"] = os.path.abspath(options.broken)
        tries = [pool.submit(planted, program, changed, folder, scene, name, options.trials)
                 for name, changed in changes.items() for scene in SCENES if options.trials > 0]
        for future in pairs:
            scene, spp, found = future.result()
            worst = max(worst, found["z"])
            unclear.setdefault((scene, spp), []).append(found["cannot_tell"] / max(found["lit_blocks"], 1))
            if found["z"] > 4:
                alarms.append((scene, spp, found))
        print(f"{len(alarms)} false alarms in {options.pairs} pairs at Z = 4; the largest z is {worst:.2f}")
        for alarm in alarms:
            print("  ", *alarm)
        print("blocks with light of which nothing can be told, at 8 and 64 samples:")
        for scene in SCENES + ["dark " + scene for scene in DARK]:
            print(f"  {scene:22}", *(f"{100 * sum(v) / len(v):5.1f} %" for k, v in sorted(unclear.items()) if k[0] == scene))
        print(f"\n{'planted change':32} {'scene':22} found  errors of the mean, of a block  floor")
        above = missed = 0
        for future in tries:
            result = future.result()
            if not result:
                continue
            scene, name, found, mean, block = result
            hits = sum(z > 4 for z in found)
            is_above = mean > MEAN_FLOOR or block > BLOCK_FLOOR
            print(f"{name:32} {scene:22} {hits:2}/{len(found)}  {mean:8.1f} {block:8.1f}   {'above' if is_above else 'below'}")
            if is_above:
                above, missed = above + len(found), missed + len(found) - hits
    shutil.rmtree(folder)
    if above:
        print(f"above the floor {above - missed} of {above} are found: {100 * (above - missed) / above:.1f} %")
        good = missed <= 0.05 * above
    return 0 if good and not alarms else 1


if __name__ == "__main__":
    sys.exit(main())
