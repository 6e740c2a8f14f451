#!/usr/bin/env python3
"""Measures how long a render takes to save and leave at a signal, and what its checkpoints cost.

Usage: saving.py TYNDALL SCRATCH [--runs N] [--threads N]

The picture has 1920 x 1080 pixels. Nothing fails here: the figures are for the table in the tests' README.
"""
import argparse
import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import time

RENDER = ["render", "cornell-box", "--size", "1920x1080", "-q"]


def until_working(process, seconds):
    """Waits until the process has used that much processor time."""
    while process.poll() is None:
        fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        if (int(fields[11]) + int(fields[12])) / 100 >= seconds:
            return
        time.sleep(0.01)


def saving(tyndall, folder, runs, threads, files):
    """Seconds from the signal to the end of the program, sorted."""
    times = []
    for _ in range(runs):
        for file in files:
            (folder / file).unlink(missing_ok=True)
        outputs = [word for file in files for word in ("-o", file)]
        process = subprocess.Popen([tyndall, *RENDER, "--spp", "1000000", "-t", threads, *outputs], cwd=folder)
        until_working(process, random.uniform(0.5, 2))
        start = time.monotonic()
        process.send_signal(signal.SIGUSR2)
        assert process.wait() == 128 + signal.SIGUSR2
        times.append(time.monotonic() - start)
        assert all((folder / file).stat().st_size > 0 for file in files)
    return sorted(times)


def rendering(tyndall, folder, threads, options):
    """Processor seconds of a render with its saving, seconds of its rendering, and its Mrays/s."""
    (folder / "c.exr").unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([tyndall, *RENDER, "--spp", "48", "-t", threads, "-o", "c.exr", "--stats", "c.json", *options], cwd=folder,
                   check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    stats = json.loads((folder / "c.json").read_text())
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, stats["seconds_render"], stats["mrays_per_s"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tyndall", type=lambda text: str(pathlib.Path(text).resolve()))
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=100)
    parser.add_argument("--threads", default=str(len(os.sched_getaffinity(0))))
    arguments = parser.parse_args()
    arguments.scratch.mkdir(parents=True, exist_ok=True)
    threads = arguments.threads
    for files in (["a.png"], ["a.exr"], ["a.exr", "a.png"]):
        times = saving(arguments.tyndall, arguments.scratch, arguments.runs, threads, files)
        print(f"{' '.join(files):12} {len(times)} runs: median {times[len(times) // 2]:.2f} s, "
              f"99 % {times[min(int(0.99 * len(times)), len(times) - 1)]:.2f} s, at most {times[-1]:.2f} s", flush=True)
    for name, options in (("no checkpoints", ["--checkpoint", "0"]), ("one in 10 s", ["--checkpoint", "10"]),
                          ("one a second", ["--checkpoint", "1"])):
        runs = sorted(rendering(arguments.tyndall, arguments.scratch, threads, options) for _ in range(3))
        work, wall, rate = runs[len(runs) // 2]
        print(f"{name}: {work:.2f} s of processor time, {wall:.2f} s of rendering, {rate:.2f} Mrays/s", flush=True)


if __name__ == "__main__":
    main()
