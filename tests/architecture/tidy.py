#!/usr/bin/env python3
"""clang-tidy, as .clang-tidy says, over C++ files of the tree, each with the include folders and definitions of its target.

    tidy.py --root FOLDER --build FOLDER PATH...      every .cpp file below the paths
    tidy.py --root FOLDER --build FOLDER --changed    the lines that a change has written (tests/support/changed_files.py), in the
                                                      newest MOST files of it, with STEPWRIGHT_LONG in all; findings of other
                                                      lines are left alone

Prints what it finds and exits with 1; a file takes five seconds or so. The tree is written for g++: a file that clang cannot
read (its concepts do not take every range of g++'s library) is named and left alone.
"""

import argparse
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from changed_files import changed_files, changed_lines  # noqa: E402

# As many as two processors look at in half a minute.
MOST = 4
# Compiled for a board by its own compiler, or for libFuzzer: no target here has their flags.
ELSEWHERE = re.compile(r"firmware/boards/|tests/fuzz/.*_fuzzer\.cpp$")
# What clang says where it is at its end, in place of a finding.
UNREAD = "[clang-diagnostic-error]"
# Of a target's command what clang needs to read its files.
KEPT = re.compile(r"-[DI].+|-std=.+|-fno-(exceptions|rtti)")


def flags_by_folder(root: pathlib.Path, build: pathlib.Path) -> dict[str, list[str]]:
    """The flags of the targets that a folder declares, by the folder: where CMake puts their objects says so."""
    flags: dict[str, list[str]] = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        words = shlex.split(entry["command"])
        folder = words[words.index("-o") + 1].split("CMakeFiles/")[0].strip("/")
        kept = flags.setdefault(folder, [])
        for word, after in zip(words, words[1:] + [""]):
            if word == "-isystem":
                word += after
            if (KEPT.fullmatch(word) or word.startswith("-isystem")) and word not in kept:
                kept.append(word)
    return flags


def flags_of(name: str, flags: dict[str, list[str]], root: pathlib.Path) -> list[str]:
    """Those of the nearest folder above; a file that no target here compiles gets the root to include from."""
    for folder in pathlib.PurePosixPath(name).parents:
        if str(folder) in flags:
            return flags[str(folder)]
    return ["-std=c++20", f"-I{root}"]


def tidy(name: str, flags: dict[str, list[str]], root: pathlib.Path, lines: list[dict] | None) -> str:
    only = [] if lines is None else ["--line-filter=" + json.dumps(lines)]
    done = subprocess.run(["clang-tidy", "--quiet", *only, name, "--", *flags_of(name, flags, root)],
                          cwd=root, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode else ""


def below(paths: list[str], root: pathlib.Path) -> list[str]:
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "--cached", "--others", "--exclude-standard", "--", *paths],
                            capture_output=True, check=True, text=True)
    return listed.stdout.splitlines()


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", required=True, type=pathlib.Path)
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--changed", action="store_true")
    parser.add_argument("paths", nargs="*")
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    names = changed_files(root) if arguments.changed else below(arguments.paths, root)
    if names is None:
        print("git tells of no commit before this one: nothing to compare with")
        return 0
    names = [name for name in names if name.endswith((".cpp", ".h"))]
    lines = None
    if arguments.changed:
        written = {name: pieces for name in names if (pieces := changed_lines(root, name))}
        names = [name for name in written if name.endswith(".cpp") and not ELSEWHERE.search(name)]
        lines = [{"name": name, "lines": pieces} for name, pieces in written.items()]
    else:
        names = [name for name in names if name.endswith(".cpp") and not ELSEWHERE.search(name)]
    chosen = names[:MOST] if arguments.changed and not os.environ.get("STEPWRIGHT_LONG") else names
    if not arguments.changed and not chosen:
        print("no C++ file there")
        return 2
    flags = flags_by_folder(root, arguments.build.resolve())
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [each for each in pool.map(lambda name: (name, tidy(name, flags, root, lines)), chosen) if each[1]]
    unread = [name for name, text in found if UNREAD in text]
    problems = [text for name, text in found if name not in unread]
    print("\n".join([*problems, *(f"{name}: clang cannot read it" for name in unread)]))
    more = f" of {len(names)} that changed, the newest first" if arguments.changed else ""
    if left := len(names) - len(chosen):
        more += f" ({left} are left out: STEPWRIGHT_LONG=1 takes all)"
    print(f"{len(chosen)} files{more}: {len(problems)} with findings")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
