"""Pairs of serial lines without wires, for tests: what goes into one end comes out of the other."""

import subprocess

from processes import eventually


class Line:
    """socat's pair of pseudo terminals: Line(folder) has two ends, `slave` and `master`."""

    def __init__(self, folder, name="line"):
        self.slave, self.master = folder / f"{name}-slave", folder / f"{name}-master"
        self.process = subprocess.Popen(["socat", f"pty,raw,echo=0,link={self.slave}", f"pty,raw,echo=0,link={self.master}"])
        assert eventually(lambda: self.slave.exists() and self.master.exists(), 10), "socat made no line"

    def close(self):
        self.process.terminate()
        self.process.wait()
