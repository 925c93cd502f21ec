#!/usr/bin/env python3
"""Decisions by the codes of messages: none compares with a code that is spelled on the spot.

Whoever decides by a code names the constant that stands where the code is made. Prints each comparison with a
literal as file:line and exits with 1.
"""

import pathlib
import re
import sys

FOLDERS = ["runtime", "supervisor", "ladder", "plant_models", "cell", "programs", "firmware", "hmi_web"]
SUFFIXES = {".h", ".cpp", ".ts", ".svelte"}
BEGIN = r"""["'][A-Z]{1,2}[0-9]{2,4}"""
CODE = BEGIN + r"""["']"""
COMPARED = re.compile(
    rf"[=!]==?\s*{CODE}|{CODE}\s*[=!]==?"
    rf"|\b(?:starts_with|ends_with|find|rfind|contains|compare|startsWith|includes|case)\s*\(?\s*{BEGIN}"
)


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    found = [
        f"{path.relative_to(root)}:{number}: {line.strip()}"
        for folder in FOLDERS
        for path in sorted((root / folder).rglob("*"))
        if path.suffix in SUFFIXES and "node_modules" not in path.parts
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if COMPARED.search(line)
    ]
    print("\n".join(found) or "no decision hangs on the spelling of a code")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
