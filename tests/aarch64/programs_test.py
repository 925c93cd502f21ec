#!/usr/bin/env python3
"""Every language program in both engines, here and on AArch64: all four runs must leave the same trace."""

import argparse
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

# Their last bit is that of the platform's C library (runtime/operations/elementary.h).
ELEMENTARY = ("SIN(", "COS(", "TAN(", "ASIN(", "ACOS(", "ATAN(", "ATAN2(", "EXP(", "LN(", "LOG(", "EXPT(", "**")


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


def main():
    parser = argparse.ArgumentParser()
    for name in ("--compiler", "--programs", "--here", "--there"):
        parser.add_argument(name, required=True)
    arguments = parser.parse_args()
    sources = sorted(pathlib.Path(arguments.programs).rglob("*.st"))
    with tempfile.TemporaryDirectory() as folder:
        programs = compile_all(arguments.compiler, sources, pathlib.Path(folder))
        containers = [container for _, container in programs]
        runs = {
            (machine, engine): trace(command, engine, containers)
            for machine, command in (("here", [arguments.here]), ("there", arguments.there.split(";")))
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
    print(f"{len(programs)} programs, {trapped} of them trap")
    if len(programs) < 500 or trapped == 0:
        problems.append("too few programs to say anything")
    print("\n".join(problems))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
