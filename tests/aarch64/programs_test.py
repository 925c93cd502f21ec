#!/usr/bin/env python3
"""Language programs in both engines, here and on AArch64: all four runs must leave the same trace.

A run takes one of eight parts of the programs (parts.py), and those that the change touches (tests/support/changed_files.py).
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import zlib
from concurrent.futures import ThreadPoolExecutor

from changed_files import changed_files
from parts import PARTS, note_passed, part_of_run, tell

PROGRAMS = "tests/st/programs"
# There are over 500; a part of less than half of its share says nothing.
LEAST = 500

# Their last bit is that of the platform's C library (runtime/operations/elementary.h).
ELEMENTARY = ("SIN(", "COS(", "TAN(", "ASIN(", "ACOS(", "ATAN(", "ATAN2(", "EXP(", "LN(", "LOG(", "EXPT(", "**")


def in_part(name, part):
    """A program stays in its part whatever programs come beside it."""
    return part is None or zlib.crc32(name.encode()) % PARTS + 1 == part


def compile_all(compiler, sources, folder):
    """The containers of the programs that compile; those of diagnostics do not."""

    def compile_one(source):
        container = folder / (source.parent.name + "_" + source.stem + ".swb")
        command = [compiler, "compile", str(source), "-o", str(container)]
        done = subprocess.run(command, capture_output=True)
        return (source, container) if done.returncode == 0 else None

    with ThreadPoolExecutor(2) as pool:
        return [each for each in pool.map(compile_one, sources) if each]


def trace(command, engine, containers):
    done = subprocess.run([*command, engine, *map(str, containers)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{command[-1]} {engine}: {done.stderr}")
    return done.stdout.splitlines()


def differences(programs, here, there):
    """What is not the same on every engine and machine, and how many programs trap."""
    containers = [container for _, container in programs]
    runs = {
        (machine, engine): trace(command, engine, containers)
        for machine, command in (("here", here), ("there", there))
        for engine in ("vm", "native")
    }
    problems = []
    trapped = 0
    for i, (source, _) in enumerate(programs):
        machines = [("here", "there")]
        if any(word in source.read_text().upper().replace(" (", "(") for word in ELEMENTARY):
            machines = [("here",), ("there",)]
        for group in machines:
            lines = {runs[machine, engine][i] for machine in group for engine in ("vm", "native")}
            if len(lines) != 1:
                problems.append(f"{source.name}: {sorted(lines)}")
        trapped += not runs["here", "vm"][i].endswith(" 0:0:0")
    return problems, trapped


def main():
    parser = argparse.ArgumentParser()
    for name in ("--compiler", "--root", "--state", "--here", "--there"):
        parser.add_argument(name, required=True)
    arguments = parser.parse_args()
    root, state = pathlib.Path(arguments.root), pathlib.Path(arguments.state)
    part = part_of_run(root, state)
    touched = set(changed_files(root) or [])
    names = sorted(path.relative_to(root).as_posix() for path in (root / PROGRAMS).rglob("*.st"))
    chosen = [name for name in names if name in touched or in_part(name, part)]
    tell(part, f", {sum(not in_part(name, part) for name in chosen)} others that the change touches")
    with tempfile.TemporaryDirectory() as folder:
        programs = compile_all(arguments.compiler, [root / name for name in chosen], pathlib.Path(folder))
        problems, trapped = differences(programs, [arguments.here], arguments.there.split(";"))
    print(f"{len(programs)} programs, {trapped} of them trap")
    if len(programs) < (LEAST // (2 * PARTS) if part else LEAST) or trapped == 0:
        problems.append("too few programs to say anything")
    print("\n".join(problems))
    if not problems:
        note_passed(part, state)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
