#!/usr/bin/env python3
"""Fails when objects of a wide instruction set define what others could run by mistake.

Usage: check_kernel_symbols.py NM OBJDUMP SET OBJECT...

A weak function compiled for a wide instruction set may be the copy that the linker keeps for every caller, and then faults on an
older processor. So such objects may define only weak symbols whose names carry the set's own tag. Weak read-only data is
allowed: every copy is the same. They may not have static initialisers either: those run before any check of the processor.
"""
import re
import subprocess
import sys

# Mangled, with lengths: tyndall's own namespace of the set, and Highway's.
TAGS = {"sse4": "4sse4|6N_SSE4", "avx2": "4avx2|6N_AVX2", "avx512": "6avx512|[0-9]N_AVX3"}
INITIALISER = "_GLOBAL__sub_I|__static_initialization|__cxx_global_var_init"


def lines_of(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines()


def problems_of(nm, objdump, instruction_set, file):
    for line in lines_of(nm, "--format=sysv", "--defined-only", file):
        parts = [part.strip() for part in line.split("|")]  # name, value, class, type, size, line, section
        if len(parts) != 7 or parts[0] == "Name":
            continue
        name, symbol, section = parts[0], parts[2], parts[6]
        weak = symbol in "WVu" and not section.startswith(".rodata") and not name.startswith("DW.ref.")
        if re.match(INITIALISER, name):
            yield f"static initialiser {name}"
        elif weak and not re.search(TAGS[instruction_set], name):
            yield f"weak symbol {name}"
    for line in lines_of(objdump, "-h", file):
        if found := re.search(r" \.(init_array|ctors)", line):
            yield f"static initialiser, section .{found[1]}"


if __name__ == "__main__":
    objects = [argument for argument in sys.argv[4:] if argument.endswith(".o")]
    found = [f"{file}: {problem}" for file in objects for problem in problems_of(*sys.argv[1:4], file)]
    print("\n".join(found))
    sys.exit(1 if found or not objects else 0)
