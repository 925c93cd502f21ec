#!/usr/bin/env python3
"""Configures and builds a project in a build folder of its own, and writes what it was made of, so that the build around it
knows when to run it again.

    cross_build.py --source FOLDER --build FOLDER --stamp FILE -- CMAKE_OPTION...

Writes FILE and, for Ninja, FILE.d. Quiet when all is well.
"""

import argparse
import pathlib
import subprocess
import sys


def run(*command: str) -> str:
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout)
    return done.stdout


def files_of(build: str) -> list[pathlib.Path]:
    """The files that the build reads and does not make: sources, the headers that the compiler saw, CMake's own files."""
    named = run("ninja", "-C", build, "-t", "inputs", "all", "build.ninja").splitlines()
    named += [line.strip() for line in run("ninja", "-C", build, "-t", "deps").splitlines() if line.startswith(" ")]
    made_in = pathlib.Path(build).resolve()
    paths = {(made_in / name).resolve() for name in named}
    return sorted(path for path in paths if not path.is_relative_to(made_in) and path.is_file())


def main() -> None:
    parser = argparse.ArgumentParser()
    for name in ("--source", "--build", "--stamp"):
        parser.add_argument(name, required=True)
    parser.add_argument("options", nargs="*")
    arguments = parser.parse_args()
    build = arguments.build
    # Each time, for the options of this call; it takes a moment where nothing is new.
    run("cmake", "-G", "Ninja", "-S", arguments.source, "-B", build, *arguments.options)
    run("ninja", "-C", build, "-j2")
    stamp = pathlib.Path(arguments.stamp)
    read = " ".join(str(path).replace(" ", "\\ ") for path in files_of(build))
    stamp.with_name(stamp.name + ".d").write_text(f"{stamp}: {read}\n", encoding="utf-8")
    stamp.touch()


if __name__ == "__main__":
    main()
