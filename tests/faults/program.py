"""A program that is run in a folder of its own, with a library between it and the system."""
import argparse
import os
import pathlib
import shutil
import subprocess


class Program:
    def __init__(self, tyndall, shim, folder):
        self.tyndall, self.shim, self.folder = tyndall, shim, folder
        self.problems, self.errors = [], 0

    def fail(self, text):
        self.problems.append(text)
        print("FAIL:", text, flush=True)

    def run(self, command, **variables):
        """The exit code, and what it wrote on standard error. variables: of the environment."""
        environment = {**os.environ, "LD_PRELOAD": str(self.shim), **{name: str(value) for name, value in variables.items()}}
        done = subprocess.run([self.tyndall, *command], cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        return done.returncode, done.stderr.decode(errors="replace").strip()

    def succeed(self, command, **variables):
        code, text = self.run(command, **variables)
        assert code == 0, text

    def start(self, kept=None):
        """The folder as it was kept, or empty."""
        shutil.rmtree(self.folder, ignore_errors=True)
        if kept and kept.exists():
            shutil.copytree(kept, self.folder)
        else:
            self.folder.mkdir()

    def keep(self, name):
        kept = self.folder.parent / ("kept-" + name)
        shutil.rmtree(kept, ignore_errors=True)
        return shutil.copytree(self.folder, kept)

    def contents(self, names):
        return {n: (self.folder / n).read_bytes() if (self.folder / n).exists() else None for n in names}

    def strays(self):
        return sorted(p.name for p in self.folder.iterdir() if ".tmp-" in p.name)


def arguments(**numbers):
    """The command line, and an empty folder SCRATCH. numbers: further options and their defaults."""
    parser = argparse.ArgumentParser()
    for name in ("tyndall", "shim", "scratch"):
        parser.add_argument(name, type=lambda text: pathlib.Path(text).resolve())
    for name, default in numbers.items():
        parser.add_argument("--" + name, type=int, default=default)
    parser.add_argument("--only", nargs="*")
    found = parser.parse_args()
    shutil.rmtree(found.scratch, ignore_errors=True)
    found.scratch.mkdir(parents=True)
    return found
