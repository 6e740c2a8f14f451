#!/usr/bin/env python3
"""Fails when a crash, an error of the system or a kill leaves a file that is neither old nor new, loses more than one
interval of a render, changes its bits, or leaves something behind after the next run.

Usage: faults.py TYNDALL SHIM SCRATCH [--every N] [--kills N] [--only NAME...]

SHIM: the library of shim.cpp, which numbers the calls that a command makes. First each command runs unharmed, which says
what "new" is. Then it is killed before, after and in the middle of each call (--every N: of each Nth), and each call fails
with one error and another, once and for good. After each of them the same command runs again, and must end as if nothing
had been. --kills N: that many kills at random times, of a render with checkpoints. It writes into memory where the system
has a folder for that: a disk may take seconds for what a program waits for, and this is to tell what the program costs.
"""
import errno
import json
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from program import Program, arguments

SMALL = ["--size", "16x16", "-t", "1", "-q"]
ERRORS = ["EIO", "ENOSPC", "EACCES"]
INTERVAL = 1.0  # seconds between the checkpoints of renders that are killed at random
ON_TIME = 0.99  # share of the kills that cost at most one interval; the others cost at most two
ENOUGH = 0.2    # of a processor: a render that gets less on a busy machine cannot do anything on time, so it is not judged
MEMORY = pathlib.Path("/dev/shm")
MUST_BE_TOLD = {"write", "lseek", "fsync", "rename"}


class Scenario:
    """A command, the folder that it finds, and the files that it writes. images: compared bit by bit."""

    def __init__(self, name, command, before, images, others=()):
        self.name, self.command, self.before, self.images, self.others = name, command, before, images, others

    def outputs(self):
        return [*self.images, *self.others]


def scenarios():
    two, box = ["render", "cornell-box", *SMALL], "cornell-box"
    files = ["-o", "a.exr", "-o", "a.png", "--stats", "a.json"]
    yield Scenario("save", two + ["--spp", "2", *files], [two + ["--spp", "1", *files]], ["a.exr", "a.png"], ["a.json"])
    yield Scenario("save-first", two + ["--spp", "2", "-o", "a.pfm", "-o", "a.hdr"], [], ["a.pfm", "a.hdr"])
    long = two + ["--spp", "900", "--checkpoint", "0.001", "-o", "a.exr"]
    yield Scenario("checkpoint", long, [], ["a.exr"])
    # The film that is gone on with is the one of a killed render.
    yield Scenario("resume", two + ["--spp", "900", "-o", "a.exr"], [("killed", long)], ["a.exr"])
    parts = [["render", box, *SMALL, "--samples", f"{i}:{i + 1}", "-o", f"{i}.exr"] for i in range(3)]
    yield Scenario("merge", ["merge", "2.exr", "0.exr", "1.exr", "-o", "m.exr", "-o", "m.png"], parts, ["m.exr", "m.png"])
    yield Scenario("scene", ["convert", box, "-o", "a.json"], [["convert", "showroom", "-o", "a.json"]], ["a.json"])


class Faults(Program):
    def __init__(self, tyndall, shim, scratch):
        super().__init__(tyndall, shim, scratch / "work")
        self.log = scratch / "calls.log"
        self.elsewhere = scratch / "elsewhere"  # where the program puts what cannot be written where it belongs
        self.cases, self.crashes = 0, 0

    def run(self, command, **fault):
        self.log.unlink(missing_ok=True)
        return super().run(command, FAULT_UNDER=self.folder, FAULT_LOG=self.log, TMPDIR=self.elsewhere,
                           **{"FAULT_" + key.upper(): value for key, value in fault.items()})

    def calls(self):
        return self.log.read_text().split("\n")[:-1] if self.log.exists() else []

    def start(self, kept=None):
        super().start(kept)
        shutil.rmtree(self.elsewhere, ignore_errors=True)
        self.elsewhere.mkdir()

    def prepare(self, scenario):
        self.start()
        for command in scenario.before:
            if command[0] == "killed":
                code, text = self.run(command[1], at=self.second_checkpoint(command[1]), mode="after")
                assert code == -signal.SIGKILL, text
            else:
                self.succeed(command)
        kept = self.keep(scenario.name)
        old = self.contents(scenario.outputs())
        self.succeed(scenario.command)
        self.check_order(scenario, self.calls())
        return kept, old, self.contents(scenario.outputs()), self.calls()

    def check_order(self, scenario, calls):
        """What is renamed must be on the disk before, and its folder afterwards: no crash of a process shows that."""
        for at, call in enumerate(calls):
            if call != "rename":
                continue
            before = [c for c in calls[:at] if c in ("write", "fsync")]
            after = [c for c in calls[at + 1:] if c in ("write", "rename", "fsync")]
            if before[-1:] != ["fsync"] or after[:1] != ["fsync"]:
                self.fail(f"{scenario.name}: a file is renamed that is not on the disk, or its folder is not put there")
        if "rename" not in calls:
            self.fail(f"{scenario.name}: no file is renamed")

    def second_checkpoint(self, command):
        self.succeed(command)
        renames = [i for i, call in enumerate(self.calls(), 1) if call == "rename"]
        self.start()
        return renames[1]

    def check_files(self, where, scenario, old, new, exact):
        now = self.contents(scenario.outputs())
        for name in scenario.outputs():
            known = now[name] in (old[name], new[name])
            if name in scenario.others and now[name] not in (None, old[name]):
                known = self.is_json(now[name])
            if not known and exact:
                self.fail(f"{where}: {name} is neither old nor new")
        return now

    @staticmethod
    def is_json(text):
        try:
            json.loads(text)
            return True
        except ValueError:
            return False

    def check_next(self, where, scenario, new):
        """The same command runs again, and everything is as if nothing had been."""
        code, text = self.run(scenario.command)
        if code != 0:
            self.fail(f"{where}: the next run ends with {code}: {text}")
        now = self.contents(scenario.outputs())
        for name in scenario.images:
            if now[name] != new[name]:
                self.fail(f"{where}: after the next run {name} has other bits")
        if self.strays():
            self.fail(f"{where}: after the next run there is {self.strays()}")

    def one(self, scenario, kept, old, new, where, **fault):
        self.cases += 1
        self.start(kept)
        code, text = self.run(scenario.command, **fault)
        calls = self.calls()
        exact = scenario.name not in ("checkpoint", "resume")
        now = self.check_files(where, scenario, old, new, exact)
        if not exact and "rename" in calls and now["a.exr"] is None:
            self.fail(f"{where}: a checkpoint was written, and is not there")
        if fault["mode"] == "error":
            self.errors += 1
            if code < 0 or (code != 0 and not text):
                self.fail(f"{where}: ends with {code}: {text or 'without a word'}")
            new_files = all(now[name] == new[name] for name in scenario.images)
            failed = [call.split()[0] for call in calls if call.endswith("failed")]
            told = code != 0 or (not exact and "no checkpoint was written" in text)
            if not told and any(call in MUST_BE_TOLD for call in failed):
                self.fail(f"{where}: ends with {code}, and does not tell: {text}")
            if exact and "rename" in failed and not self.rescued(text):
                self.fail(f"{where}: ends with {code}, and what could not be renamed is lost: {text}")
            if code == 0 and not new_files:
                self.fail(f"{where}: ends with 0, and not all files are new: {text}")
        else:
            self.crashes += code == -signal.SIGKILL
            if code not in (0, -signal.SIGKILL):
                self.fail(f"{where}: ends with {code}: {text}")
        self.check_next(where, scenario, new)

    def rescued(self, text):
        """Whether the message names a whole file that holds what could not be put in its place."""
        places = re.findall(r"it is in (\S+) instead", text)
        return bool(places) and all((self.folder / place).stat().st_size > 0 for place in places)

    def go_through(self, scenario, every):
        kept, old, new, calls = self.prepare(scenario)
        last = min(len(calls), 150) if scenario.name == "checkpoint" else len(calls)
        offset = random.randrange(every)
        for at in range(1 + offset, last + 1, every):
            name = calls[at - 1]
            modes = ["before", "after"] + (["half"] if name == "write" else [])
            for mode in modes:
                self.one(scenario, kept, old, new, f"{scenario.name}: {mode} call {at} ({name})", at=at, mode=mode)
            number = ERRORS[at // every % len(ERRORS)]
            for forever in (0, 1):
                self.one(scenario, kept, old, new, f"{scenario.name}: {number} in call {at} ({name}), forever {forever}",
                         at=at, mode="error", errno=getattr(errno, number), forever=forever)
        print(f"{scenario.name}: {last} calls, {self.cases} cases so far", flush=True)

    def begun(self, name):
        """When the file was created, which is when the film that it holds was copied; seconds."""
        return float(subprocess.run(["stat", "--printf=%.9W", self.folder / name], stdout=subprocess.PIPE, check=True).stdout)

    @staticmethod
    def processor_seconds():
        """Of all programs that have ended."""
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    def check_lost(self, kills):
        """What kills have cost: hardly ever more than one interval, and never more than two. kills: pairs of seconds lost
        and of the share of a processor that the render had."""
        judged = [seconds for seconds, share in kills if share >= ENOUGH]
        for what, lost in (("all", [seconds for seconds, _ in kills]), (f"that had {ENOUGH} of a processor", judged)):
            if not lost:
                continue
            lost.sort()
            within = sum(seconds <= INTERVAL for seconds in lost) / len(lost)
            print(f"work lost by kills of {len(lost)} renders ({what}), with {INTERVAL} s between checkpoints: median "
                  f"{lost[len(lost) // 2]:.3f} s, of 99 % at most {lost[int(0.99 * len(lost))]:.3f} s, at most "
                  f"{lost[-1]:.3f} s; of {100 * within:.1f} % at most {INTERVAL} s")
        if judged and (judged[-1] > 2 * INTERVAL or (len(judged) >= 100 and within < ON_TIME)):
            self.fail(f"kills: more than {INTERVAL} s of work are lost in {100 * (1 - within):.1f} % of the kills")

    def kill_at_random(self, kills):
        """Kills renders with checkpoints at random times until they are whole; then their bits must be those of one go."""
        command = ["render", "cornell-box", "--size", "24x16", "--spp", "6000", "-t", "1", "-q", "--checkpoint", str(INTERVAL),
                   "-o", "a.exr", "--stats", "a.json"]
        self.start()
        begin = time.monotonic()
        assert self.run(command)[0] == 0
        seconds = time.monotonic() - begin
        command[5] = str(int(6000 * max(1, 5 * INTERVAL / seconds)))
        whole, killed, finished = None, 0, 0
        lost = []
        self.start()
        used = self.processor_seconds()
        while killed < kills:
            started = time.time()
            process = subprocess.Popen([self.tyndall, *command], cwd=self.folder, stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            try:
                text = process.communicate(timeout=random.uniform(0, 4 * INTERVAL))[1]
                if process.returncode != 0:
                    self.fail(f"kills: ends with {process.returncode}: {text.decode()}")
                    return
                if self.strays():
                    self.fail(f"kills: after {killed} kills there is {self.strays()}")
                found = self.contents(["a.exr"])
                self.start()
                if whole is None:
                    assert self.run(command)[0] == 0
                    whole = self.contents(["a.exr"])
                    self.start()
                if found != whole:
                    self.fail(f"kills: after {killed} kills the film has other bits")
                finished += 1
            except subprocess.TimeoutExpired:
                now = time.time()
                process.kill()
                process.communicate()
                killed += 1
                share = (self.processor_seconds() - used) / (now - started)
                kept = self.begun("a.exr") if (self.folder / "a.exr").exists() else 0
                lost.append((now - max(started, kept), share))
            used = self.processor_seconds()
        self.check_lost(lost)
        print(f"{killed} random kills; {finished} times the render was whole in between, bit for bit", flush=True)


def main():
    given = arguments(every=1, kills=0)
    seed = random.randrange(1 << 32)
    random.seed(seed)
    print("seed", seed)
    faults = Faults(given.tyndall, given.shim, given.scratch)
    for scenario in scenarios():
        if not given.only or scenario.name in given.only:
            faults.go_through(scenario, given.every)
    if given.kills:
        with tempfile.TemporaryDirectory(prefix="tyndall-kills-", dir=MEMORY if MEMORY.is_dir() else None) as folder:
            faults.folder = pathlib.Path(folder) / "work"
            faults.kill_at_random(given.kills)
    print(f"{faults.crashes} crash points, {faults.errors} errors: {len(faults.problems)} problems")
    return 1 if faults.problems else 0


if __name__ == "__main__":
    sys.exit(main())
