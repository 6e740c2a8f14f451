#!/usr/bin/env python3
"""Where adding machines stops paying: the time of one picture on 1 to 1000 machines, from measured parts.

Usage: simulate.py [SAMPLES]   SAMPLES: per pixel, 1024 by default

A farm takes: start + samples / (rate * machines) + writing a part, on all machines at once, and then, on one machine, the
merge, which reads one part after the other. START, what a queue takes to begin a job, is assumed. The others were measured on
the machine of tests/bench/README.md: processor seconds of one core; RATE is cornell-smoke on two cores.
"""
import sys

RATE = 21.8e6  # samples a second of one machine
START = 2.0  # seconds, assumed
WRITE = 0.5  # seconds per megapixel: film and layers of one part, compressed
MERGE_FIXED, MERGE_PART = 0.6, 0.62  # seconds per megapixel: writing the sum; reading and adding one part
SIZES = [("720p", 1280 * 720), ("1080p", 1920 * 1080), ("4K", 3840 * 2160), ("8K", 7680 * 4320)]
MACHINES = [1, 10, 100, 1000]


def seconds(pixels, samples, machines):
    megapixels = pixels / 1e6
    alone = START + pixels * samples / RATE / machines + WRITE * megapixels
    return alone if machines == 1 else alone + (MERGE_FIXED + MERGE_PART * machines) * megapixels


def main():
    samples = int(sys.argv[1]) if len(sys.argv) > 1 else 1024
    print(f"| {samples} samples a pixel | " + " | ".join(f"{m:,}" for m in MACHINES) + " | best number | with it |")
    print("|---" * (len(MACHINES) + 3) + "|")
    for name, pixels in SIZES:
        best = min(range(1, 1001), key=lambda m: seconds(pixels, samples, m))
        times = " | ".join(f"{seconds(pixels, samples, m):,.0f} s" for m in MACHINES)
        print(f"| {name} | {times} | {best} | {seconds(pixels, samples, best):,.0f} s |")


if __name__ == "__main__":
    main()
