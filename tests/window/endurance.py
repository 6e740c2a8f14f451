#!/usr/bin/env python3
"""Sends random input to a window, and fails if it ends or its memory grows.

Usage: endurance.py PROCESS WINDOW ORIGINAL SCENE LOG MINUTES

Every half a minute the input stops and the scene is written anew, as an editor does: the window reads it. The memory
that it has then is compared with that of other such points at which the window held the same: as many pictures, of the
same size, clean or not. Points at which it still shows a much larger scene are left out, and so are the first ten
minutes, in which histories and caches fill. After them the slope must be 0 within its 95 % confidence interval, or less
than 1 % of the memory in MINUTES. 0 minutes: ends after these ten, and memory is not judged.

The slope is the median of those between all pairs of comparable points, with Kendall's test for its confidence interval
(P. K. Sen, Estimates of the Regression Coefficient Based on Kendall's Tau, Journal of the American Statistical
Association 63, 1968; over groups of points, R. M. Hirsch, J. R. Slack and R. A. Smith, Techniques of Trend Analysis for
Monthly Water Quality Data, Water Resources Research 18, 1982). Least squares would be misled by the few points in which
the window still holds what the input before them asked for: their spread is not normal.

Counted is memory of the process alone. Pages of libraries that are in memory come and go with what the system does
with them: the compiler of shaders in software OpenGL alone has 110 MB of them.
"""
import math
import pathlib
import random
import shutil
import statistics
import subprocess
import sys
import time

# No letters that save or quit; digits and signs reach the fields that a click has opened.
KEYS = """a b c d e f g h i j k l m n o p r t u v w x y z 1 2 3 4 5 6 7 8 9 0 minus period Tab Escape Return space BackSpace
Delete Insert Home End Left Right Up Down Prior Next F1 slash bracketleft bracketright ctrl+z ctrl+y ctrl+shift+z ctrl+k
ctrl+d ctrl+a shift+Tab ctrl+Right""".split()
WARM_UP = 10  # minutes


class Input:
    """Random input through one xdotool."""

    def __init__(self, window):
        self.tool = subprocess.Popen(["xdotool", "-"], stdin=subprocess.PIPE, text=True)
        self.window = window

    def send(self, *words):
        self.tool.stdin.write(" ".join(map(str, words)) + "\n")
        self.tool.stdin.flush()

    def step(self):
        kind = random.random()
        x, y = random.randrange(1000), random.randrange(900)
        if kind < 0.4:
            self.send("mousemove", "--window", self.window, x, y)
        elif kind < 0.6:
            self.send("click", random.choice([1, 1, 1, 3, 4, 5]))
        elif kind < 0.7:
            button = random.choice([1, 1, 2, 3])
            self.send("mousedown", button)
            for _ in range(random.randrange(6)):
                self.send("mousemove", "--window", self.window, random.randrange(1000), random.randrange(900))
            self.send("mouseup", button)
        elif kind < 0.99:
            self.send("key", random.choice(KEYS))
        else:
            self.send("windowsize", self.window, random.randrange(300, 1000), random.randrange(200, 900))


def memory(process):
    """kB of the process alone that are in memory; 0: it has ended."""
    try:
        lines = pathlib.Path(f"/proc/{process}/status").read_text().split("\n")
        return next((int(line.split()[1]) for line in lines if line.startswith("RssAnon")), 0)
    except OSError:
        return 0


def slope(groups):
    """Of kB over seconds: the median, and the two ends of its 95 % confidence interval. None: too few points."""
    slopes = sorted((b[1] - a[1]) / (b[0] - a[0])
                    for points in groups for i, a in enumerate(points) for b in points[i + 1:])
    if len(slopes) < 3:
        return None
    spread = 1.96 * math.sqrt(sum(n * (n - 1) * (2 * n + 5) / 18 for n in map(len, groups)))
    first = max(math.floor((len(slopes) - spread) / 2), 0)
    return statistics.median(slopes), slopes[first], slopes[-1 - first]


def held(log):
    """What the window holds, such as "1 of 320 x 200 clean"."""
    lines = [line for line in log.read_text(errors="replace").split("\n") if line.startswith("pictures ")]
    return lines[-1].removeprefix("pictures ") if lines else ""


def wait_for_rest(log):
    """Until the window rests, or 15 seconds: a picture without a limit, for example, never does."""
    size = log.stat().st_size
    time.sleep(3)  # by then it has seen that the scene's file is another one
    for _ in range(60):
        time.sleep(0.2)
        with log.open(errors="replace") as file:
            file.seek(size)
            lines = [line for line in file if not line.startswith("drawn")]
        if lines and lines[-1] == "rest\n":
            return


def calm(tool, original, scene, log):
    """Brings the window to the scene as it was at the start."""
    tool.send("key", "Escape")
    tool.send("key", "Escape")
    tool.send("windowsize", tool.window, 1000, 900)
    for _ in range(40):
        tool.send("key", "ctrl+z")
    new = scene.with_suffix(".new")
    shutil.copy(original, new)
    new.rename(scene)
    wait_for_rest(log)


def main():
    process, window = sys.argv[1], sys.argv[2]
    original, scene, log, minutes = *map(pathlib.Path, sys.argv[3:6]), float(sys.argv[6])
    seed = random.randrange(1 << 32)
    random.seed(seed)
    print("seed", seed, flush=True)
    tool, start, groups, steps = Input(window), time.monotonic(), {}, 0
    while (now := time.monotonic() - start) < 60 * (WARM_UP + minutes):
        until = time.monotonic() + 25
        while time.monotonic() < until:
            tool.step()
            steps += 1
            time.sleep(0.02)
            if memory(process) == 0:
                print(f"the window ended after {now:.0f} s and {steps} steps")
                return 1
        calm(tool, original, scene, log)
        point = (time.monotonic() - start, memory(process))
        print(f"{point[0]:6.0f} s  {steps:6} steps  {point[1]} kB  {held(log)}", flush=True)
        if point[0] > 60 * WARM_UP:
            groups.setdefault(held(log), []).append(point)
    if minutes == 0:
        return 0
    level = statistics.median(y for points in groups.values() for _, y in points)
    found = slope([[(x, y) for x, y in points if y < 1.5 * statistics.median(y for _, y in points)]
                   for points in groups.values()])
    if not found:
        print("too short to tell a slope")
        return 1
    value, low, high = found
    growth = value * 60 * minutes / level
    print(f"memory {level:.0f} kB, slope {value:.3f} kB/s, with 95 % confidence from {low:.3f} to {high:.3f}, "
          f"{100 * growth:.2f} % in {minutes:g} minutes")
    return 0 if abs(growth) < 0.01 or low <= 0 <= high else 1


if __name__ == "__main__":
    sys.exit(main())
