#!/usr/bin/env python3
"""Runs the target for libFuzzer on all readers; fails when an input crashes one, hangs it or takes too much memory.

Usage: fuzz.py ROOT BUILD SCRATCH [--runs N] [--jobs N] [--only NAME...]

ROOT: the source tree. BUILD: where the target is built, with Clang, if it is not yet. SCRATCH: gets the inputs, and
what crashes. --runs: executions of all readers together. Exit code 77 (skipped) without Clang.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

# What is read, and what reads it. Images have one reader, which tells formats by their first bytes.
READERS = {"scene": "scene", "set": "set", "png": "image", "jpeg": "image", "hdr": "image", "pfm": "image",
           "ppm": "image", "bmp": "image", "tga": "image",
           "exr": "image", "film": "film", "merge": "merge", "arguments": "arguments", "compare": "compare"}
LONGEST = {"scene": 4096, "film": 16384}  # bytes of an input; else 8192
OVERRIDES = ["/camera/vfov=30\n/objects/0/radius=-2", "/materials/white/albedo=[1, 0, 0]\n/camera/look_from/1=3",
             "/render/integrator=nee\n/materials/white={\"type\": \"metal\", \"albedo\": [1, 1, 1], \"fuzz\": 0}"]
COMMANDS = ["render\ncornell-box\n--size\n20x10\n--spp=4\n-o\na.exr\n--samples\n0:4\n--region\n0,0,4,4",
            "compare\na.png\nb.png\n--max-rmse\n1e-3\n--json", "merge\na.exr\nb.exr\n-o\nc.exr", "chart\nquads\n-o\na.svg",
            "verify\nplate\n--isa\nscalar", "inspect\nquads\n--json", "view\nquads\n--set\n/camera/vfov=3", "-V",
            "denoise\na.exr\n-o\na.png", "convert\nquads\n-o\n-", "render\nquads\n--replay\n1,2,3\n--checkpoint\n5"]

# What overrides, command lines and headers of images are made of, as libFuzzer writes bytes.
WORDS = r"""1e308 -0.0 \"\\u0000\" ~0 ~1 /camera/vfov= /materials/white/albedo/0= /objects/0/radius=
    render\x0a merge\x0a compare\x0a denoise\x0a --samples\x0a --size=2x2 --region\x0a --set\x0a --output=a.exr --checkpoint=1
    IHDR IDAT PLTE tRNS gAMA iCCP cHRM cICP eXIf iTXttyndall:scene\x00 Exif\x00\x00II*\x00 \xff\xc4 \xff\xdb \xff\xda \xff\xc2
    channels\x00chlist\x00 compression\x00compression\x00 dataWindow\x00box2i\x00 tiles\x00tiledesc\x00 stringvector\x00
    film.taken\x00 #?RADIANCE\x0aFORMAT=32-bit_rle_rgbe\x0a -Y\x204\x20+X\x208\x0a +X\x204\x20-Y\x208\x0a EXPOSURE=2\x0a
    COLORCORR=1\x202\x203\x0a PF\x0a4\x204\x0a-1\x0a Pf P3\x202\x202\x20255\x0a P6\x202\x202\x2065535\x0a""".split()


def build(root, folder):
    if shutil.which("clang++-14") is None:
        print("skipped: there is no clang++-14")
        sys.exit(77)
    quiet = {"stdout": subprocess.DEVNULL, "check": True}
    subprocess.run(["cmake", "--preset", "fuzz", "-B", folder], cwd=root, **quiet)
    subprocess.run(["cmake", "--build", folder, "--parallel", "2"], cwd=root, **quiet)


def make_seeds(root, folder, seeds):
    subprocess.run([folder / "make_seeds", seeds], check=True)
    for reader in READERS:
        (seeds / reader).mkdir(exist_ok=True)
    shutil.copy(root / "tests/image/film_of_format_0.exr", seeds / "film")
    scenes = [scene.read_text() for scene in root.glob("assets/scenes/*.json")]
    bad = (root / "tests/scene/bad_scenes.txt").read_text().splitlines()
    scenes += [f'{{ "tyndall": 1, {line} }}' for line in bad if line.startswith('  "')]
    for number, text in enumerate(scenes):
        if len(text.encode()) < LONGEST["scene"]:
            (seeds / "scene" / str(number)).write_text(text)
    for name, texts in (("set", OVERRIDES), ("arguments", COMMANDS)):
        for number, text in enumerate(texts):
            (seeds / name / str(number)).write_text(text)
    (seeds / "merge" / "three").write_bytes(bytes([0, 0, 0, 4, 0, 4, 0, 8, 0, 4, 0, 4, 0, 4, 0, 4, 0, 4]))
    (seeds / "compare" / "grey").write_bytes(bytes([3]) + bytes([0, 0, 0, 63]) * 96)


def write_words(root, file):
    """The dictionary: these words, and all names that a scene may have, as keys and as values."""
    names = sorted(set(re.findall(r'"([a-z][a-z_0-9]*)"', (root / "assets/scene.schema.json").read_text())))
    scene = [rf'\"{name}\"{end}' for name in names for end in (":", "")]
    file.write_text("".join(f'"{word}"\n' for word in WORDS + scene))


def fuzz(reader, folder, scratch, runs):
    """Returns the number of executions, what is covered, and what was found."""
    inputs, found = scratch / "inputs" / reader, scratch / "found" / reader
    inputs.mkdir(parents=True)
    found.mkdir(parents=True)
    command = [folder / "fuzz", inputs, scratch / "seeds" / reader, f"-runs={runs}", "-timeout=20",
               f"-max_len={LONGEST.get(reader, 8192)}", f"-dict={scratch}/words.dict", "-malloc_limit_mb=256",
               "-rss_limit_mb=2048", f"-artifact_prefix={found}/", "-print_final_stats=1", "-verbosity=1"]
    environment = {**os.environ, "TYNDALL_FUZZ": READERS[reader],
                   "ASAN_OPTIONS": "allocator_may_return_null=0:detect_leaks=1"}
    done = subprocess.run(command, cwd=scratch, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE)
    log = done.stderr.decode(errors="replace")
    (scratch / f"{reader}.log").write_text(log)
    executions = re.findall(r"number_of_executed_units: (\d+)", log)
    covered = re.findall(r"cov: (\d+) ft: (\d+)", log)
    problems = sorted(file.name for file in found.iterdir())
    if done.returncode != 0 and not problems:
        problems.append(f"exit code {done.returncode}, see {scratch / reader}.log")
    return reader, int(executions[-1]) if executions else 0, covered[-1] if covered else ("0", "0"), problems


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=1_000_000)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", nargs="*", choices=READERS, default=list(READERS))
    arguments = parser.parse_args()
    root, folder, scratch = (path.resolve() for path in (arguments.root, arguments.build, arguments.scratch))
    build(root, folder)
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "seeds").mkdir(parents=True)
    make_seeds(root, folder, scratch / "seeds")
    write_words(root, scratch / "words.dict")
    each, total, bad = -(-arguments.runs // len(arguments.only)), 0, 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        tasks = [pool.submit(fuzz, reader, folder, scratch, each) for reader in arguments.only]
        for task in tasks:
            reader, executions, (edges, features), problems = task.result()
            print(f"{reader:10} {executions:8} executions, {edges:>6} edges and {features:>6} features covered, "
                  f"{len(problems)} findings {' '.join(problems)}", flush=True)
            total, bad = total + executions, bad + len(problems)
    print(f"{total} executions, {bad} findings")
    return 1 if bad or total < arguments.runs else 0


if __name__ == "__main__":
    sys.exit(main())
