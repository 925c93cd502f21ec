"""File systems of a test's own, in a mount namespace that ends with it."""

import ctypes
import pathlib
import subprocess
import unittest

CLONE_NEWNS = 0x00020000
_private = None


def need_mounts():
    """Skips the test where this user may not mount."""
    global _private
    if _private is None:
        libc = ctypes.CDLL(None, use_errno=True)
        _private = libc.unshare(CLONE_NEWNS) == 0 and subprocess.run(
            ["mount", "--make-rprivate", "/"], capture_output=True, check=False).returncode == 0
    if not _private:
        raise unittest.SkipTest("this test mounts file systems of its own, which needs root")


def mount(folder, *options):
    pathlib.Path(folder).mkdir(exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", ",".join(["mode=0700", *options]), "stepwright-test", folder], check=True)


def remount(folder, *options):
    subprocess.run(["mount", "-o", ",".join(("remount", *options)), folder], check=True)


def make_read_only(folder):
    """For whoever opens something from now on; files that are open stay so."""
    subprocess.run(["mount", "--bind", folder, folder], check=True)
    remount(folder, "bind", "ro")


def unmount(folder):
    subprocess.run(["umount", "-l", folder], check=False)


def empty(folder):
    """What `fill` has put there is gone."""
    for each in [pathlib.Path(folder) / "filler", *pathlib.Path(folder).glob("file*")]:
        each.unlink(missing_ok=True)


def fill(folder):
    """Until not a byte and not a file more fits."""
    try:
        with open(pathlib.Path(folder) / "filler", "ab", buffering=0) as file:
            while True:
                file.write(b"x" * 4096)
    except OSError:
        pass
    try:
        for number in range(100_000):
            (pathlib.Path(folder) / f"file{number}").touch(exist_ok=False)
    except OSError:
        pass
