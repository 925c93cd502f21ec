"""Builds an FMU of fmu/NAME.c and fmu/NAME.xml with the system's C compiler: fmu_pack.py NAME FILE.fmu"""

import pathlib
import platform
import subprocess
import sys
import tempfile
import zipfile

HERE = pathlib.Path(__file__).parent / "fmu"
MACHINE = platform.machine()
PLATFORMS = {"2": "linux64" if MACHINE == "x86_64" else "aarch64-linux", "3": f"{MACHINE}-linux"}


def pack(name, target, folder=None, description=None, more=()):
    """`folder` of binaries/ instead of this machine's; `description` instead of the file's; more (name, text)."""
    with tempfile.TemporaryDirectory() as place:
        library = pathlib.Path(place) / f"{name}.so"
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-fvisibility=hidden", "-o", library, HERE / f"{name}.c"],
                       check=True)
        with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("modelDescription.xml", description or (HERE / f"{name}.xml").read_text(encoding="utf-8"))
            archive.write(library, f"binaries/{folder or PLATFORMS[name[-1]]}/{name}.so")
            for each, text in more:
                archive.writestr(each, text)
    return target


if __name__ == "__main__":
    pack(sys.argv[1], sys.argv[2])
