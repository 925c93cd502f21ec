"""Pages of the user's book whose commands are executed: all ```sh blocks, in order, in a clean folder."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from namespaces import need_network_of_its_own
from processes import BIN, PATIENCE_S, SOURCES, stepwright

BOOK = SOURCES / "doc"
MOST_LINES = 100  # two pages


def page(name):
    return (BOOK / name).read_text(encoding="utf-8")


def blocks(text):
    return re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S)


class Guide(unittest.TestCase):
    """A folder for one guide, in a network of its own: the page of a guide has the port that everybody's has."""

    def setUp(self):
        need_network_of_its_own()
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)

    def bash(self, script, folder):
        """Runs commands; the Python of devices is that of the system, as in the guides."""
        environment = {**os.environ, "PATH": f"{BIN}:/usr/bin:{os.environ['PATH']}", "EXAMPLES": str(BOOK / "examples")}
        try:
            done = subprocess.run(["bash", "-e", "-c", script], cwd=folder, capture_output=True, text=True, timeout=PATIENCE_S,
                                  check=False, env=environment)
        except subprocess.TimeoutExpired as late:
            self.fail(f"no end of\n{script}\n{late.stdout}\n{late.stderr}")
        self.assertEqual(done.returncode, 0, f"{script}\n{done.stdout}{done.stderr}")
        return done.stdout

    def ends_with_the_test(self, cell):
        self.addCleanup(stepwright, "down", self.root / cell)
