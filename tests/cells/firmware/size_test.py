#!/usr/bin/env python3
"""Flash and RAM of the images, from their sections: fails if one is larger than it may be.

Flash is all that is programmed: code, constants, initial data. RAM is data, stack and what is never initialised;
the memory of programs (image, VM stack, retained values, the verifier's scratch) is beside it.
"""

import json
import pathlib
import subprocess
import sys

KIB = 1024
# image: (flash, RAM)
LIMITS = {"mps2-an385-basic": (64 * KIB, 16 * KIB), "mps2-an385": (92 * KIB, 16 * KIB), "mps2-an386": (92 * KIB, 16 * KIB)}


def sizes(image: pathlib.Path) -> tuple[int, int]:
    text = subprocess.run(["arm-none-eabi-size", "-A", str(image)], capture_output=True, text=True, check=True).stdout
    section = {fields[0]: int(fields[1]) for fields in map(str.split, text.splitlines())
               if len(fields) == 3 and fields[1].isdigit()}
    flash = section[".text"] + section.get(".exidx", 0) + section[".data"]
    ram = section[".data"] + section[".bss"] + section[".stack"] + section[".noinit"]
    return flash, ram


def main() -> int:
    folder = pathlib.Path(sys.argv[1])
    found = {name: sizes(folder / f"{name}.elf") for name in LIMITS}
    print(json.dumps({name: {"flash_bytes": flash, "ram_bytes": ram} for name, (flash, ram) in found.items()}, indent=1))
    too_large = [name for name, (flash, ram) in found.items() if flash > LIMITS[name][0] or ram > LIMITS[name][1]]
    for name in too_large:
        print(f"{name} is too large: at most {LIMITS[name][0]} bytes of flash and {LIMITS[name][1]} of RAM", file=sys.stderr)
    return 1 if too_large else 0


if __name__ == "__main__":
    sys.exit(main())
