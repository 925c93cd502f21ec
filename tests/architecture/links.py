#!/usr/bin/env python3
"""Every library links with only what it declares: whatever its objects need and do not have is in a library that it names in
its CMakeLists.txt, in one that such a library names, or in the compiler's own.

    links.py DESCRIPTION COMPILER LIBRARY...

DESCRIPTION is what links.cmake writes. The symbols are those that the linker would see (readelf); nothing is linked. Prints each
symbol that is missing with the library that has it, and exits with 1.
"""

import pathlib
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

# What a compiler links to every program.
RUNTIME = ("libstdc++.so", "libm.so.6", "libc.so.6", "libc_nonshared.a", "libgcc.a", "libgcc_s.so.1")
# What the linker makes, the loader has, and a sanitizer brings.
MADE = re.compile(r"_GLOBAL_OFFSET_TABLE_|__dso_handle|__tls_get_addr|__ehdr_start|__start_\w+|__stop_\w+|__(asan|tsan|ubsan|sanitizer)_\w+")


@dataclass
class Target:
    """A library, what it declares, and its symbols."""

    name: str
    file: str
    declared: list[str]
    defined: set[str] = field(default_factory=set)
    needed: dict[str, str] = field(default_factory=dict)  # symbol: object


def described(text: str) -> dict[str, Target]:
    targets = {}
    for line in text.splitlines():
        name, file, declared = line.split("|")
        targets[name] = Target(name, file, [each for each in declared.split(",") if each])
    return targets


def compiler_file(compiler: str, name: str) -> str:
    """Where the compiler has a library; the name itself where it has none."""
    return subprocess.run([compiler, f"-print-file-name={name}"], capture_output=True, check=True, text=True).stdout.strip()


def add_system_libraries(targets: dict[str, Target], compiler: str) -> None:
    """What is declared and is no target: a file, a name such as pthread, an option of the linker."""
    for item in {item for target in targets.values() for item in target.declared} - set(targets):
        file = item
        if not item.startswith("/"):
            file = "" if re.match(r"-(?!l)|.*::@", item) else compiler_file(compiler, f"lib{item.removeprefix('-l')}.so")
        targets[item] = Target(item, file if pathlib.Path(file).is_absolute() else "", [])


def read_symbols(target: Target) -> None:
    if not target.file:
        return
    shared = re.search(r"\.so(\.|$)", target.file)
    if shared and pathlib.Path(target.file).read_bytes()[:4] != b"\x7fELF":
        return  # a linker's script in place of a library: what it names comes with the compiler
    listed = subprocess.run(["readelf", "-W", "--dyn-syms" if shared else "--syms", target.file],
                            capture_output=True, check=True, text=True)
    member = pathlib.Path(target.file).name
    for line in listed.stdout.splitlines():
        if line.startswith("File: ") and line.endswith(")"):
            member = line[line.rindex("(") + 1 : -1]
            continue
        words = line.split()  # Num: Value Size Type Bind Vis Ndx Name
        if len(words) < 8 or words[4] not in ("GLOBAL", "WEAK", "UNIQUE"):
            continue
        symbol = words[7].split("@")[0]
        if words[6] != "UND":
            target.defined.add(symbol)
        elif words[4] == "GLOBAL" and not shared:  # weak and defined nowhere: may be missing
            target.needed.setdefault(symbol, member)


def reached(targets: dict[str, Target], start: str) -> set[str]:
    seen, waiting = set(), [start]
    while waiting:
        name = waiting.pop()
        if name not in seen:
            seen.add(name)
            waiting += targets[name].declared
    return seen


def plain(symbol: str) -> str:
    return subprocess.run(["c++filt", symbol], capture_output=True, check=True, text=True).stdout.strip()


def missing(targets: dict[str, Target], library: str, always: set[str]) -> list[str]:
    within = reached(targets, library)
    problems = []
    for symbol, member in sorted(targets[library].needed.items()):
        if symbol in always or MADE.fullmatch(symbol) or any(symbol in targets[name].defined for name in within):
            continue
        owners = [name for name, target in targets.items() if symbol in target.defined]
        where = f"which {owners[0]} has: {library} does not declare it" if owners else "which no library here has"
        problems.append(f"{library} ({member}): needs {plain(symbol)}, {where}")
    return problems


def main() -> int:
    description, compiler, *libraries = sys.argv[1:]
    targets = described(pathlib.Path(description).read_text(encoding="utf-8"))
    add_system_libraries(targets, compiler)
    runtime = [Target(name, compiler_file(compiler, name), []) for name in RUNTIME]
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(read_symbols, [*targets.values(), *runtime]))
    always = set().union(*(each.defined for each in runtime))
    problems = [problem for library in libraries for problem in missing(targets, library, always)]
    empty = [library for library in libraries if not targets[library].defined]
    problems += [f"{library}: {targets[library].file} defines nothing: it was not read" for library in empty]
    print("\n".join(problems) or f"{len(libraries)} libraries link with what they declare")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
