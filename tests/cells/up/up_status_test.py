"""`stepwright status` tells how the program is, not only its processes; `up` with a disk that is full says so."""

import unittest

from kept_cell import KeptCell
from mounts import fill, mount, need_mounts, unmount
from processes import eventually

TRAPS = """\
PROGRAM Main
  VAR n, zero : DINT; END_VAR
  n := 1 / zero;
END_PROGRAM
"""


class Status(unittest.TestCase):
    def kept(self, **options):
        cell = KeptCell(**options)
        self.addCleanup(cell.__exit__)
        return cell

    def program(self, cell):
        return cell.status().get("program", {}).get("state")

    def test_a_program_that_runs_is_told_with_its_clock(self):
        cell = self.kept()
        cell.ready()
        self.assertTrue(eventually(lambda: self.program(cell) == "running"), cell.status())
        status = cell.run("status")
        self.assertEqual(status.returncode, 0, status.stdout)
        self.assertRegex(status.stdout, r"(?m)^  program running \(real clock\)")

    def test_a_program_in_fault_is_told_with_its_reason_and_by_the_exit_code(self):
        cell = self.kept(program=TRAPS)
        cell.ready()
        self.assertTrue(eventually(lambda: self.program(cell) == "fault"), cell.status())
        status = cell.run("status")
        self.assertEqual(status.returncode, 5, status.stdout)
        self.assertRegex(status.stdout, r"(?m)^  program fault \(real clock\): .*zero")
        record = cell.status()
        self.assertEqual({each["phase"] for each in record["processes"]}, {"ready"})
        self.assertEqual(record["program"]["mode"], "real clock")
        self.assertIn("zero", record["program"]["detail"])


class FullDisk(unittest.TestCase):
    def cell(self):
        """A cell whose state folder has room for files and none for what is in them."""
        need_mounts()
        cell = KeptCell()
        self.addCleanup(cell.__exit__)
        mount(cell.state, "size=64k", "nr_inodes=64")
        self.addCleanup(unmount, cell.state)
        fill(cell.state)
        for each in cell.state.glob("file*"):
            each.unlink()
        return cell

    def test_detached_it_is_told_and_nothing_is_left(self):
        cell = self.cell()
        done = cell.run("up", "--detach")
        self.assertEqual(done.returncode, 5, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"state/up\.log: M0022: the log cannot be written: No space left on device")
        self.assertEqual(cell.run("status").returncode, 5)
        self.assertIn("is not up", cell.run("status").stdout)

    def test_on_a_terminal_it_is_told_and_nothing_is_left(self):
        cell = self.cell()
        process = cell.up()
        self.assertEqual(process.wait(), 5, process.output())
        self.assertRegex(process.output(), r"state/up\.json: E0002: .*No space left on device")
        self.assertIn("is not up", cell.run("status").stdout)


if __name__ == "__main__":
    unittest.main()
