#!/usr/bin/env python3
"""Keeps files short (house rule 5): median at most 120 lines, 95th percentile at most 450, none above 800."""

import pathlib
import subprocess
import sys

SUFFIXES = {".h", ".cpp", ".ts", ".svelte", ".py", ".cmake", ".idl", ".mjs"}


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    listed = subprocess.run(
        ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        capture_output=True, check=True, text=True,
    ).stdout.split("\0")
    sizes = sorted(
        (len((root / name).read_text(encoding="utf-8").splitlines()), name)
        for name in listed
        if pathlib.Path(name).suffix in SUFFIXES and (root / name).is_file()
    )
    median = sizes[len(sizes) // 2][0]
    percentile_95 = sizes[int(len(sizes) * 0.95)][0]
    print(f"{len(sizes)} files: median {median}, 95th percentile {percentile_95}, longest {sizes[-1]}")
    too_long = [f"  {lines} {name}" for lines, name in sizes if lines > 800]
    print("\n".join(too_long))
    return 0 if median <= 120 and percentile_95 <= 450 and not too_long else 1


if __name__ == "__main__":
    sys.exit(main())
