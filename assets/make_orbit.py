#!/usr/bin/env python3
"""Makes an animated picture of a camera that swings around a scene: raw on the left, the clean view on the right.

    python3 assets/make_orbit.py build/release/tyndall showroom assets/pictures/orbit.gif
    python3 assets/make_orbit.py build/release/tyndall cornell-smoke smoke.gif --frames 60 --folder frames

Both halves take about the same time: the raw one gets as many more samples as the filter's time buys. Every frame has
random numbers of its own (--seed), as pictures of an interactive view have. Needs ImageMagick's `convert`. --folder
keeps the frames.
"""

import argparse
import json
import math
import subprocess
import tempfile
from pathlib import Path


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def orbit(camera, angle):
    """The camera after a turn about the vertical axis through what it looks at, in radians."""
    eye, aim = camera["look_from"], camera["look_at"]
    x, z = eye[0] - aim[0], eye[2] - aim[2]
    cos, sin = math.cos(angle), math.sin(angle)
    return [aim[0] + cos * x + sin * z, eye[1], aim[2] - sin * x + cos * z]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tyndall")
    parser.add_argument("scene")
    parser.add_argument("out", type=Path)
    parser.add_argument("--frames", type=int, default=24)
    parser.add_argument("--size", default="240x136", help="of each half")
    parser.add_argument("--spp", type=int, default=4, help="samples a pixel of the clean half")
    parser.add_argument("--swing", type=float, default=12, help="degrees to each side")
    parser.add_argument("--folder", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.folder or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / "scene.json"
        run(options.tyndall, "convert", options.scene, "-o", file)
        camera = json.loads(file.read_text())["camera"]
        raw_spp, frames = options.spp, []
        for frame in range(options.frames):
            turn = math.radians(options.swing) * math.sin(2 * math.pi * frame / options.frames)
            look_from = json.dumps(orbit(camera, turn))
            common = ["render", options.scene, "--set", f"/camera/look_from={look_from}", "--size", options.size, "-q",
                      "--seed", frame]
            clean, raw = folder / f"clean-{frame:03}.png", folder / f"raw-{frame:03}.png"
            stats = json.loads(run(options.tyndall, *common, "--spp", options.spp, "--denoise", "-o", clean,
                                   "--stats", "-"))
            if frame == 0:
                share = 1 + stats["seconds_denoise"] / stats["seconds_render"]
                raw_spp = max(options.spp, round(options.spp * min(share, 4)))
            run(options.tyndall, *common, "--spp", raw_spp, "-o", raw)
            both = folder / f"both-{frame:03}.png"
            run("convert", raw, clean, "+append", "+repage", both)
            frames.append(both)
        run("convert", "-delay", 8, "-loop", 0, *frames, "-layers", "Optimize", options.out)
        print(f"{options.out}: {options.out.stat().st_size} bytes; {raw_spp} samples a pixel on the left, "
              f"{options.spp} and the filter on the right")


if __name__ == "__main__":
    main()
