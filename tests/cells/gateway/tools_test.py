"""The tools of a runtime on a controller behind Modbus that runs by its own clock, its I/O in shared memory."""

import hashlib
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import unittest

from cell_process import STEPWRIGHT, stepwright
from controllers import Controller, eventually

PROGRAM = """\
PROGRAM Main
  VAR button AT %IX0.0 : BOOL; lamp AT %QX0.0 : BOOL; ready AT %QX0.1 : BOOL; count : DINT; END_VAR
  ready := TRUE;
  lamp := button;
  count := count + 1;
END_PROGRAM
"""
CELL = """\
[cell]
name = "{name}"
state_dir = "state"
[clock]
mode = "real"
[plant]
kind = "none"
[io]
kind = "shared_memory"
[image]
input_bytes = 8
output_bytes = 8
[safe_state.lost_io]
"%QX0.7" = "one"
[controller]
kind = "modbus-rtu"
device = "{device}"
lost_after_ms = 3000
"""


class Area:
    """The plant's side of the shared memory (runtime/doc/shared_memory_io.md)."""

    def __init__(self, name):
        self.file = pathlib.Path("/dev/shm") / f"stepwright-io-{name}"

    def bytes(self):
        return self.file.read_bytes()

    def output(self):
        """The first byte of the outputs."""
        area = self.bytes()
        at = struct.unpack_from("<I", area, 24)[0]
        count = struct.unpack_from("<Q", area, at)[0]
        return area[at + 64 + (count % 2) * (16 + 8) + 16]

    def set_input(self, value):
        area = self.bytes()
        at = struct.unpack_from("<I", area, 20)[0]
        count = struct.unpack_from("<Q", area, at)[0] + 1
        with open(self.file, "r+b") as memory:
            memory.seek(at + 64 + (count % 2) * (16 + 8))
            memory.write(struct.pack("<QQB", 0, 0, value))
            memory.flush()
            memory.seek(at)
            memory.write(struct.pack("<Q", count))


class Tools(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.controller = Controller()
        self.addCleanup(self.controller.__exit__)
        name = f"gw{os.getpid()}"
        self.area = Area(name)
        self.addCleanup(lambda: self.area.file.unlink(missing_ok=True))
        self.cell = self.folder / "cell.toml"
        self.cell.write_text(CELL.format(name=name, device=self.controller.where), encoding="utf-8")
        source = self.folder / "main.st"
        source.write_text(PROGRAM, encoding="utf-8")
        self.image = self.folder / "main.swb"
        self.assertEqual(stepwright("compile", source, "-o", self.image).returncode, 0)
        self.log = self.folder / "gateway.log"
        self.losses = 0
        self.gateway = self.start_gateway()

    def start_gateway(self):
        with open(self.log, "a", encoding="utf-8") as log:
            gateway = subprocess.Popen([STEPWRIGHT, "gateway", "--config", self.cell], stdout=log, stderr=log)
        self.addCleanup(gateway.wait)
        self.addCleanup(gateway.kill)
        self.assertTrue(eventually(lambda: "listens on" in self.said()), self.said())
        return gateway

    def said(self):
        return self.log.read_text(encoding="utf-8")

    def is_well(self):
        """Starts the program again where the controller has lost its plant: a busy machine may hold up the gateway for so long."""
        losses = self.said().count("heard nothing of its plant")
        if losses > self.losses:
            self.losses = losses
            self.run_tool("start")
        return True

    def drives(self, value):
        return eventually(lambda: self.is_well() and self.area.output() == value)

    def run_tool(self, command, *arguments, code=0):
        done = stepwright(command, "--config", self.cell, *arguments)
        self.assertEqual(done.returncode, code, f"{command}: {done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def count(self):
        return int(re.search(r"count\D+(\d+)", self.run_tool("snapshot"), re.I).group(1))

    def test_download_start_watch_force_and_stop(self):
        self.run_tool("download", self.image, "--replace")
        self.run_tool("start")
        self.assertTrue(self.drives(2))
        self.area.set_input(1)
        self.assertTrue(self.drives(3))
        before = self.count()
        self.assertTrue(eventually(lambda: self.is_well() and self.count() > before + 5))
        self.run_tool("force", "Main.button", "FALSE")
        self.assertTrue(self.drives(2))
        self.assertIn("button", self.run_tool("forces"))
        self.run_tool("unforce", "Main.button")
        self.assertTrue(self.drives(3))
        self.run_tool("stop")
        self.assertEqual(self.area.output(), 0)

    def test_a_controller_is_given_the_program_without_its_sources(self):
        bare = self.folder / "bare.swb"
        self.assertEqual(stepwright("compile", self.folder / "main.st", "--bare", "-o", bare).returncode, 0)
        self.assertLess(bare.stat().st_size, self.image.stat().st_size)
        digest = hashlib.sha256(bare.read_bytes()).hexdigest()
        self.assertIn(digest[:12], self.run_tool("download", self.image, "--replace"))

    def test_what_it_cannot_do_is_refused_with_a_hint(self):
        self.run_tool("download", self.image, "--replace")
        self.run_tool("start")
        for refused in (self.run_tool("download", self.image, "--change", code=1),
                        self.run_tool("record", self.folder / "run.swrec", "--seconds", "1", code=1)):
            self.assertIn("R0147", refused)
            self.assertIn("hint:", refused)
        self.assertTrue(self.drives(2))  # and it runs on

    def test_a_silent_controller_leaves_the_cells_safe_outputs_and_is_started_again(self):
        self.run_tool("download", self.image, "--replace")
        self.run_tool("start")
        self.assertTrue(self.drives(2))
        self.controller.silence()
        self.assertTrue(eventually(lambda: self.area.output() == 0x80))
        self.assertTrue(eventually(lambda: "R0141" in self.said()), self.said())  # a log's lines come by and by
        self.assertIn("R0141", self.run_tool("start", code=1))
        self.controller.speak()
        self.assertTrue(eventually(lambda: self.said().count("the controller answers") == 2))
        self.run_tool("start")
        self.assertTrue(self.drives(2))

    def test_a_gateway_that_was_killed_finds_the_program_and_what_became_of_it(self):
        self.run_tool("download", self.image, "--replace")
        self.run_tool("start")
        self.gateway.kill()
        self.gateway.wait()
        self.log.write_text("", encoding="utf-8")
        self.losses = 0
        self.start_gateway()
        self.run_tool("stop")
        self.run_tool("start")  # its program was in the controller
        self.assertTrue(self.drives(2))


if __name__ == "__main__":
    unittest.main()
