"""Whoever reads the log goes away, or does not read: it costs lines and nothing else."""

import fcntl
import os
import signal
import subprocess
import unittest

from processes import NO_PLANT, PATIENCE_S, STEPWRIGHT, Cell, eventually

REAL = NO_PLANT + '[clock]\nmode = "real"\n[log]\nlimit_per_s = 1000\n'
PIPE_BYTES = 4096


class PipedRuntime:
    """A runtime whose log is a pipe, as small as the system makes one."""

    def __init__(self, cell):
        self.reader, writer = os.pipe()
        fcntl.fcntl(self.reader, fcntl.F_SETPIPE_SZ, PIPE_BYTES)
        self.process = subprocess.Popen([STEPWRIGHT, "runtime", "--config", cell.config], stdout=writer, stderr=writer)
        os.close(writer)

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        try:
            return self.process.wait(timeout=PATIENCE_S)
        finally:
            self.process.kill()


def outlives_broken_pipes(process):
    """Whether SIGPIPE has a handler (which, unlike ignoring it, started programs do not inherit)."""
    with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
        caught = next(int(line.split()[1], 16) for line in status if line.startswith("SigCgt:"))
    return caught >> (signal.SIGPIPE - 1) & 1 == 1


class LogReader(unittest.TestCase):
    def setUp(self):
        self.cell = Cell(REAL)
        self.addCleanup(self.cell.__exit__)
        self.runtime = PipedRuntime(self.cell)
        self.addCleanup(self.runtime.process.kill)
        self.assertTrue(eventually(self.cell.served))
        self.cell.load(1_000)

    def scans_go_on(self):
        before = self.cell.figure("stepwright_scans_total")
        self.assertTrue(eventually(lambda: self.cell.figure("stepwright_scans_total") > before + 100))

    def test_a_reader_that_goes_away_costs_the_lines(self):
        os.close(self.runtime.reader)
        for _ in range(5):
            self.cell.load(1_000, "hello")
        self.scans_go_on()
        self.assertEqual(self.runtime.end(), 0)

    def test_a_reader_that_does_not_read_holds_nobody_up(self):
        for _ in range(60):  # many times what the pipe takes
            self.cell.load(1_000, "hello")
        self.scans_go_on()
        # Everything is still there for a reader that comes back, line by line.
        with os.fdopen(self.runtime.reader, encoding="utf-8") as lines:
            came = 0
            for line in lines:
                self.assertRegex(line, r"^\d{4}-.* runtime: ")
                came += "came" in line
                if came == 60:
                    break
            self.assertEqual(self.runtime.end(), 0)

    def test_every_process_of_a_cell_outlives_its_readers(self):
        self.assertTrue(outlives_broken_pipes(self.runtime.process))
        link = self.cell.start("link")
        link.wait_for("connected")
        self.assertTrue(outlives_broken_pipes(link))
        os.close(self.runtime.reader)


if __name__ == "__main__":
    unittest.main()
