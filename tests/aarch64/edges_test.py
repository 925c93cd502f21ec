#!/usr/bin/env python3
"""Every opcode at the edges of its operands, on AArch64: one of eight parts of the opcodes (parts.py), all of them where the change
touches what makes or runs their code."""

import argparse
import os
import pathlib
import subprocess
import sys

from changed_files import changed_files
from parts import PARTS, note_passed, part_of_run, tell

ENGINES = ("runtime/bytecode/", "runtime/native/", "runtime/operations/", "runtime/vm/", "tests/aarch64/", "tests/unit/runtime/native/")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", required=True)
    parser.add_argument("--state", required=True)
    parser.add_argument("--test", required=True, help="the engines' unit tests, and what runs them; by semicolons")
    arguments = parser.parse_args()
    root, state = pathlib.Path(arguments.root), pathlib.Path(arguments.state)
    touched = [name for name in changed_files(root) or [] if name.startswith(ENGINES)]
    part = None if touched else part_of_run(root, state)
    tell(part, " of the opcodes")
    environment = dict(os.environ)
    if part:
        environment["STEPWRIGHT_EDGE_PART"] = f"{part}/{PARTS}"
    command = [*arguments.test.split(";"), "--gtest_filter=OpcodeEdges.*", "--gtest_brief=1"]
    code = subprocess.run(command, env=environment).returncode
    if code == 0:
        note_passed(part, state)
    sys.exit(code)


if __name__ == "__main__":
    main()
