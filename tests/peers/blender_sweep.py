"""Renders the scene that an exported script has built with ever more samples, and times each. Run by peers.py:

blender -b --factory-startup -P SCENE.py -P blender_sweep.py -- FOLDER THREADS LONGEST

Writes FOLDER/N.exr for N = 1, 2, 3, 4, 6, 8, 12 … samples until one takes longer than LONGEST seconds, and a line
"sweep N SECONDS" for each. The scene stays loaded between renders (persistent data), and one render before the first loads it,
so that the time holds no loading. Path tracing on the processor without a denoiser, without adaptive sampling.
"""
import os
import sys
import time

import bpy

folder, threads, longest = sys.argv[sys.argv.index("--") + 1:][:3]
scene = bpy.context.scene
scene.render.threads_mode, scene.render.threads = "FIXED", int(threads)
scene.render.use_persistent_data = True
scene.cycles.use_auto_tile = False  # one tile: what Cycles' manual recommends where the picture fits into memory
scene.cycles.samples = 1
scene.render.filepath = os.path.join(folder, "first.exr")
bpy.ops.render.render(write_still=True)
samples, power = 1, 1  # 1, then 2, 3, 4, 6, 8, 12 …
while True:
    scene.cycles.samples = samples
    scene.cycles.seed = samples
    scene.render.filepath = os.path.join(folder, f"{samples}.exr")
    begin = time.monotonic()
    bpy.ops.render.render(write_still=True)
    seconds = time.monotonic() - begin
    print("sweep", samples, seconds, flush=True)
    if seconds > float(longest):
        break
    if samples == 2 * power:
        power, samples = 2 * power, 3 * power
    else:
        samples = 2 * power
