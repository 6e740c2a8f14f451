#!/usr/bin/env python3
"""Seconds to relMSE 0.01 and 0.001: Tyndall beside other renderers, same scenes, same machine, same run.

Usage: peers.py TYNDALL [--blender PROGRAM] [--pbrt PROGRAM] [--mitsuba PROGRAM] [--threads N] [--longest SECONDS]
                [--scenes NAME…] [--reference SAMPLES] [--json FILE] [--agree]

Needs Python's standard library and Debian's package blender; a renderer that is not there is left out. Every scene is
exported by "tyndall convert" and rendered with ever more samples; the time is that of the smallest number of samples which
reaches the error against a reference by Tyndall (4096 samples a pixel, another seed). Loading the scene is left out on both
sides: Tyndall's time is seconds_render of --stats (the median of 3), Blender's that of a render whose scene is loaded
already. An error that is never reached within --longest seconds a render, or because the scenes differ, is "-". Prints a
table in Markdown.

--agree: instead, whether the pictures are the same: each renderer's means over Tyndall's, and relMSE, at 64 samples, of
scenes that hold all conventions. Exit code 1 if a mean differs by more than 1 %.

When last run: see README.md beside this file.
"""
import argparse
import json
import os
import pathlib
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
TARGETS = (0.01, 0.001)
# Scenes that every renderer has an equal of, or nearly; fuzz is left out, as none of them has it.
SCENES = {
    "cornell-box": ["--size", "256x256"],
    "cornell-smoke": ["--size", "256x256"],
    "quads": ["--size", "256x256"],
    "glass-spheres": ["--size", "400x225"],
    "hollow-glass": ["--size", "400x225"],
    "stress-caustic-glass": ["--size", "400x225"],
    "stress-dense-fog": ["--size", "256x256"],
    "sky-spheres": ["--size", "256x144", "--set", "/materials/brushed/fuzz=0"],
}


def run(command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    if done.returncode:
        raise RuntimeError(f"{command[0]}: exit code {done.returncode}: {(done.stderr or done.stdout).strip()[-400:]}")
    return done.stdout


def counts():
    """1, 2, 3, 4, 6, 8, 12 …"""
    yield 1
    n = 2
    while True:
        yield n
        yield n + n // 2
        n *= 2


def rel_mse(tyndall, picture, reference):
    return json.loads(run([tyndall, "compare", picture, reference, "--json"]))["relmse"]


def first_that_reach(points):
    """points: (samples, seconds, relMSE) in ascending order. Of each target (samples, seconds) or None."""
    return [next(((n, s) for n, s, error in points if error <= target), None) for target in TARGETS]


def own_points(options, scene, settings, folder, reference):
    points = []
    for n in counts():
        picture, stats, seconds = folder / "own.pfm", folder / "own.json", []
        for _ in range(3):
            run([options.tyndall, "render", scene, *settings, "--spp", n, "--seed", 1, "-t", options.threads, "-q",
                 "-o", picture, "--stats", stats])
            seconds.append(json.loads(stats.read_text())["seconds_render"])
        points.append((n, statistics.median(seconds), rel_mse(options.tyndall, picture, reference)))
        if points[-1][2] <= TARGETS[-1] or points[-1][1] > options.longest:
            return points


def blender_points(options, scene_file, folder, reference):
    out = run([options.blender, "-b", "--factory-startup", "-P", scene_file, "-P", HERE / "blender_sweep.py", "--", folder,
               options.threads, options.longest])
    points = []
    for line in out.splitlines():
        if line.startswith("sweep "):
            _, n, seconds = line.split()
            points.append((int(n), float(seconds), rel_mse(options.tyndall, folder / f"{n}.exr", reference)))
    return points


def timed_points(options, command, picture, reference):
    """command(samples) renders into `picture`; what one sample takes is taken for loading."""
    points, loading = [], None
    for n in counts():
        begin = time.monotonic()
        run(command(n), cwd=picture.parent)
        seconds = time.monotonic() - begin
        loading = seconds if loading is None else loading
        points.append((n, seconds - loading, rel_mse(options.tyndall, picture, reference)))
        if points[-1][2] <= TARGETS[-1] or points[-1][1] > options.longest:
            return points


def pbrt_points(options, scene_file, folder, reference):
    picture = folder / "pbrt.exr"
    command = [options.pbrt, "--quiet", "--nthreads", options.threads, "--outfile", picture, scene_file, "--spp"]
    return timed_points(options, lambda n: [*command, n], picture, reference)


def mitsuba_points(options, scene_file, folder, reference):
    picture, text = folder / "mitsuba.exr", scene_file.read_text()
    marker = '<integer name="sample_count" value="'
    head, rest = text.split(marker)

    def command(n):
        file = scene_file.with_name("mitsuba-n.xml")
        file.write_text(f'{head}{marker}{n}"{rest.split(chr(34), 1)[1]}')
        return [options.mitsuba, "-m", "scalar_rgb", "-t", options.threads, "-o", picture, file]

    return timed_points(options, command, picture, reference)


PEERS = {"blender": (".py", blender_points), "pbrt": (".pbrt", pbrt_points), "mitsuba": (".xml", mitsuba_points)}


def processor():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines() if os.path.exists("/proc/cpuinfo") else []
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.machine())


def versions(options):
    found = {"Tyndall": run([options.tyndall, "version"]).splitlines()[0]}
    for peer in PEERS:
        program = getattr(options, peer)
        if program and shutil.which(program):
            try:
                found[peer] = run([program, "--version"]).splitlines()[0]
            except RuntimeError:
                found[peer] = program
        else:
            setattr(options, peer, None)
    return found


def measure(options, scene, folder):
    settings = SCENES[scene]
    reference = folder / "reference.pfm"
    run([options.tyndall, "render", scene, *settings, "--spp", options.reference, "--seed", 4242, "-q", "-o", reference])
    results = {"Tyndall": own_points(options, scene, settings, folder, reference)}
    width, height = settings[1].split("x")
    for peer, (ending, points) in PEERS.items():
        if not getattr(options, peer):
            continue
        here = folder / peer
        here.mkdir()
        try:
            run([options.tyndall, "convert", scene, *settings[2:], "--set", f"/image/width={width}",
                 "--set", f"/image/height={height}", "-o", here / f"scene{ending}"])
            results[peer] = points(options, here / f"scene{ending}", here, reference)
        except RuntimeError as error:
            print(f"{scene}: {peer}: {error}", file=sys.stderr)
            results[peer] = []
    return results


AGREE = {
    "cornell-box": [], "cornell-smoke": [], "earth": [], "checkered-spheres": [],
    "hollow-glass": ["--set", "/materials/gold/fuzz=0"],
    "defocus": ["--set", "/materials/gold/fuzz=0"],
    "sky-spheres": ["--set", "/materials/brushed/fuzz=0"],
    str(HERE / "conventions.json"): [],
}


def rendered_by(options, peer, file, folder):
    picture = folder / f"{peer}.exr"
    commands = {
        "blender": [options.blender, "-b", "--factory-startup", "-P", file, "--", picture, 64],
        "pbrt": [options.pbrt, "--quiet", "--spp", 64, "--outfile", picture, file],
        "mitsuba": [options.mitsuba, "-m", "scalar_rgb", "-o", picture, file],
    }
    run(commands[peer], cwd=folder)
    return picture


def agree(options):
    good = True
    print("| scene | renderer | means over Tyndall's: red, green, blue | relMSE of both at 64 samples |\n|---|---|---|---|")
    for scene, overrides in AGREE.items():
        for peer, (ending, _) in PEERS.items():
            if not getattr(options, peer):
                continue
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                size = ["--set", "/image/width=128", "--set", "/image/height=72", "--set", "/render/spp=64"]
                try:
                    run([options.tyndall, "convert", scene, *overrides, *size, "-o", folder / f"scene{ending}"])
                except RuntimeError as error:
                    print(f"| `{pathlib.Path(scene).stem}` | {peer} | {str(error).split('found')[-1].strip()} | |")
                    continue
                run([options.tyndall, "render", scene, *overrides, *size, "-q", "-o", folder / "own.exr"])
                picture = rendered_by(options, peer, folder / f"scene{ending}", folder)
                found = json.loads(run([options.tyndall, "compare", picture, folder / "own.exr", "--json"]))
            ratios = [a / b for a, b in zip(found["mean_image"], found["mean_reference"])]
            good = good and all(abs(r - 1) < 0.01 for r in ratios)
            print(f"| `{pathlib.Path(scene).stem}` | {peer} | {', '.join(f'{r:.4f}' for r in ratios)} | {found['relmse']:.2g} |",
                  flush=True)
    return 0 if good else 1


def cell(found):
    return f"{found[1]:.3g} ({found[0]})" if found else "-"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tyndall")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--pbrt")
    parser.add_argument("--mitsuba")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--longest", type=float, default=60)
    parser.add_argument("--scenes", nargs="*", default=list(SCENES))
    parser.add_argument("--reference", type=int, default=4096, help="its samples a pixel")
    parser.add_argument("--json")
    parser.add_argument("--agree", action="store_true")
    options = parser.parse_args()
    options.tyndall = os.path.abspath(options.tyndall)
    names = versions(options)
    if options.agree:
        print("; ".join(names.values()) + "\n")
        return agree(options)
    print(f"{options.threads} threads of {processor()}; " + "; ".join(names.values()) + "\n")
    columns = ["Tyndall", *(peer for peer in PEERS if getattr(options, peer))]
    print("| seconds (samples a pixel) to relMSE | " + " | ".join(f"{c}: {t:g}" for t in TARGETS for c in columns) + " |")
    print("|---" * (1 + len(TARGETS) * len(columns)) + "|")
    everything = {"threads": options.threads, "processor": processor(), "versions": names, "scenes": {}}
    for scene in options.scenes:
        with tempfile.TemporaryDirectory() as folder:
            results = measure(options, scene, pathlib.Path(folder))
        everything["scenes"][scene] = results
        reached = {name: first_that_reach(points) for name, points in results.items()}
        cells = [cell(reached[c][k]) for k in range(len(TARGETS)) for c in columns]
        print(f"| `{scene}` {SCENES[scene][1]} | " + " | ".join(cells) + " |", flush=True)
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(everything, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
