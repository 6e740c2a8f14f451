#!/usr/bin/env python3
"""Refuses each request for memory that a command makes, one a run; fails where that ends the program other than by a
message and an exit code, or leaves a file that is neither old nor new.

Usage: memory.py TYNDALL SHIM SCRATCH [--every N] [--only NAME...]

SHIM: the library of memory_shim.cpp, which counts and refuses requests. --every N: only each Nth request.
"""
import random
import sys

from program import Program, arguments

SCENE = """{"tyndall": 1, "image": {"width": 16, "height": 12},
  "camera": {"look_from": [0, 1, 4], "look_at": [0, 0.5, 0]},
  "textures": {"picture": {"type": "image", "file": "picture.png"},
               "tiles": {"type": "checker", "scale": 0.3, "even": [0.2, 0.3, 0.1], "odd": [0.9, 0.9, 0.9]}},
  "materials": {"white": {"type": "lambertian", "albedo": "picture"},
                "floor": {"type": "lambertian", "albedo": "tiles"},
                "lamp": {"type": "light", "radiance": [5, 5, 5]},
                "glass": {"type": "dielectric", "refractive_index": 1.5}},
  "objects": [{"type": "sphere", "center": [0, 0.5, 0], "radius": 0.5, "material": "glass"},
              {"type": "quad", "corner": [-3, 0, -3], "u": [6, 0, 0], "v": [0, 0, 6], "material": "floor"},
              {"type": "medium", "boundary": {"type": "box", "min": [1, 0, 0], "max": [2, 1, 1]}, "density": 1,
               "albedo": [1, 1, 1]},
              {"type": "box", "min": [-2, 0, 0], "max": [-1, 1, 1], "material": "white"},
              {"type": "quad", "corner": [-1, 3, -1], "u": [2, 0, 0], "v": [0, 0, 2], "material": "lamp"}]}"""
QUIET = ["-t", "1", "-q"]
# Name, commands that make what it reads, the command, the files that it writes.
SCENARIOS = [
    ("render", [["render", "scene.json", *QUIET, "--spp", "1", "-o", "a.exr", "-o", "a.pfm"]],
     ["render", "scene.json", *QUIET, "--spp", "2", "-o", "a.exr", "-o", "a.pfm", "-o", "a.png", "-o", "a.hdr", "--stats",
      "a.json"], ["a.exr", "a.pfm", "a.png", "a.hdr", "a.json"]),
    ("checkpoint", [], ["render", "scene.json", *QUIET, "--spp", "600", "--checkpoint", "0.001", "-o", "a.exr"], ["a.exr"]),
    ("resume", [["render", "scene.json", *QUIET, "--spp", "1", "-o", "a.exr"]],
     ["render", "scene.json", *QUIET, "--spp", "3", "--resume", "-o", "a.exr"], ["a.exr"]),
    ("merge", [["render", "scene.json", *QUIET, "--samples", f"{i}:{i + 1}", "-o", f"{i}.exr"] for i in range(3)],
     ["merge", "0.exr", "2.exr", "1.exr", "-o", "m.pfm", "-o", "m.exr"], ["m.pfm", "m.exr"]),
    ("denoise", [["render", "scene.json", *QUIET, "--spp", "4", "-o", "a.exr"]],
     ["denoise", "a.exr", "-o", "d.pfm", "-t", "1"], ["d.pfm"]),
    ("compare", [["render", "scene.json", *QUIET, "--spp", "1", "-o", "a.exr", "-o", "a.png", "-o", "a.hdr"]],
     ["compare", "a.exr", "a.png", "--heatmap", "h.png"], ["h.png"]),
    ("convert", [], ["convert", "scene.json", "-o", "c.json"], ["c.json"]),
]


class Memory(Program):
    refusals = 0

    def request(self, command, at=0):
        """Refuses this request; 0: none."""
        return self.run(command, MEMORY_AT=at, MEMORY_LOG=self.folder.parent / "requests")

    def prepare(self, name, before):
        self.start()
        (self.folder / "scene.json").write_text(SCENE)
        for command in (["render", "cornell-box", "--size", "8x8", "--spp", "1", *QUIET, "-o", "picture.png"], *before):
            self.succeed(command)
        return self.keep(name)

    def check(self, where, code, text, now, old, whole):
        """whole: what images that hold no times are when all went well."""
        self.refusals += 1
        self.errors += code != 0
        if code < 0 or code > 3 or (code != 0 and not text):
            self.fail(f"{where}: ends with {code}: {text or 'without a word'}")
        if strays := self.strays():
            self.fail(f"{where}: leaves {strays}")
        for name, content in now.items():
            if content != old[name] and name.endswith((".pfm", ".hdr")) and content != whole[name]:
                self.fail(f"{where}: {name} is neither old nor new")
            if code == 0 and content is None:
                self.fail(f"{where}: ends with 0, and there is no {name}")

    def go_through(self, name, before, command, outputs, every):
        kept = self.prepare(name, before)
        old = self.contents(outputs)
        code, text = self.request(command)
        assert code == 0, text
        whole, count = self.contents(outputs), int((self.folder.parent / "requests").read_text())
        for at in range(1 + random.Random(name).randrange(every), count + 1, every):
            self.start(kept)
            code, text = self.request(command, at)
            self.check(f"{name}: request {at}", code, text, self.contents(outputs), old, whole)
        print(f"{name}: {count} requests; so far {self.refusals} refused, {self.errors} ended in an error", flush=True)


def main():
    given = arguments(every=1)
    memory = Memory(given.tyndall, given.shim, given.scratch / "work")
    for scenario in SCENARIOS:
        if not given.only or scenario[0] in given.only:
            memory.go_through(*scenario, given.every)
    print(f"{memory.refusals} refused requests: {len(memory.problems)} problems")
    return 1 if memory.problems else 0


if __name__ == "__main__":
    sys.exit(main())
