#!/usr/bin/env python3
"""Runs a test of random programs with one of four parts of them: native_part.py ROOT PROGRAMS COMMAND ...

Which part is by the number of commits, so that each change takes another one. STEPWRIGHT_AARCH64_PART=all, which
scripts/test --long sets, takes them all. The test prints the seed of a program that fails.
"""

import os
import subprocess
import sys

PARTS = 4


def part_of(root):
    counted = subprocess.run(["git", "-C", root, "rev-list", "--count", "HEAD"], capture_output=True, text=True)
    return int(counted.stdout or 0) % PARTS


def main():
    root, programs, command = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
    first, count = 1, programs
    if os.environ.get("STEPWRIGHT_AARCH64_PART") != "all":
        count = programs // PARTS
        first += part_of(root) * count
        print(f"random programs {first} to {first + count - 1} of {programs}", flush=True)
    os.environ.update(STEPWRIGHT_FUZZ_SEED=str(first), STEPWRIGHT_FUZZ_PROGRAMS=str(count))
    os.execvp(command[0], command)


if __name__ == "__main__":
    main()
