#!/usr/bin/env python3
"""Compiles the portable core for a Cortex-M3: every source, and every header on its own.

The portable folders may include the freestanding part of C++20 and each other only; what they compile to may
neither allocate nor throw. Prints each offence and exits with 1.

    compile.py ROOT FOLDER [LAUNCHER] COMPILER    FOLDER is for objects; LAUNCHER is a compiler cache
"""

import pathlib
import re
import subprocess
import sys

FOLDERS = ["runtime/base", "runtime/bytecode", "runtime/image", "runtime/operations", "runtime/vm", "runtime/scan",
           "runtime/modbus/control", "runtime/modbus/pdu"]
STANDARD = {"array", "atomic", "bit", "cassert", "charconv", "compare", "concepts", "cstddef", "cstdint", "cstring", "limits", "span",
            "type_traits"}
FLAGS = ["-mcpu=cortex-m3", "-mthumb", "-std=c++20", "-Os", "-fno-exceptions", "-fno-rtti", "-ffp-contract=off",
         "-fno-threadsafe-statics", "-Wall", "-Wextra", "-Wshadow", "-Wconversion", "-Werror"]
SYSTEM_INCLUDE = re.compile(r"^\s*#\s*include\s+<([^>]+)>", re.M)
PROJECT_INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)/[^/"]+"', re.M)
# operator new, the allocator, exceptions and the standard library's throw helpers
FORBIDDEN = re.compile(r"\b(_Znw\w+|_Zna\w+|malloc|calloc|realloc|__cxa_throw|__cxa_allocate_exception|_ZSt\d+__throw\w+)\b")


def bad_includes(path: pathlib.Path, root: pathlib.Path) -> list[str]:
    text = path.read_text(encoding="utf-8")
    name = path.relative_to(root)
    problems = [f"{name}: <{header}> is not freestanding" for header in SYSTEM_INCLUDE.findall(text)
                if header not in STANDARD]
    problems += [f"{name}: {folder} is not portable" for folder in PROJECT_INCLUDE.findall(text)
                 if folder not in FOLDERS]
    return problems


def compile_one(path: pathlib.Path, root: pathlib.Path, compiler: list[str], objects: pathlib.Path) -> list[str]:
    name = str(path.relative_to(root))
    target = objects / (name.replace("/", "_") + ".o")
    source = path
    if path.suffix == ".h":
        source = target.with_suffix(".cpp")
        source.write_text(f'#include "{name}"\n', encoding="utf-8")
    run = subprocess.run([*compiler, *FLAGS, "-I.", "-c", str(source), "-o", str(target)], cwd=root, capture_output=True, text=True)
    if run.returncode != 0:
        return [f"{name} does not compile:\n{run.stderr}"]
    if path.suffix == ".h":
        return []
    symbols = subprocess.run([compiler[-1].replace("g++", "nm"), "--undefined-only", str(target)],
                             capture_output=True, text=True, check=True).stdout
    return [f"{name} uses {symbol}" for symbol in FORBIDDEN.findall(symbols)]


def main() -> int:
    root, objects, compiler = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]), sys.argv[3:]
    objects.mkdir(exist_ok=True)
    files = [file for folder in FOLDERS for file in sorted((root / folder).glob("*")) if file.suffix in (".h", ".cpp")]
    problems = []
    for file in files:
        problems += bad_includes(file, root) + compile_one(file, root, compiler, objects)
    print("\n".join(problems) or f"{len(files)} files compile for the Cortex-M3")
    return 1 if problems or not files else 0


if __name__ == "__main__":
    sys.exit(main())
