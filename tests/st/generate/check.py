#!/usr/bin/env python3
"""Fails if a generated language test is not what its generator writes."""

import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
PROGRAMS = HERE.parent / "programs"


def main():
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "STEPWRIGHT_PROGRAMS": folder, "PYTHONDONTWRITEBYTECODE": "1"}
        for generator in ("conversions.py", "operators.py"):
            subprocess.run([sys.executable, HERE / generator], env=environment, check=True)
        fresh = {path.relative_to(folder): path.read_text() for path in pathlib.Path(folder).rglob("*.st")}
    kept = {path.relative_to(PROGRAMS): path.read_text() for path in PROGRAMS.rglob("*.st")
            if "Generated: tests/st/generate" in path.read_text()}
    differing = sorted(str(name) for name in fresh.keys() | kept.keys() if fresh.get(name) != kept.get(name))
    print("\n".join(differing))
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
