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
# Its container is larger than what is left of the disk for small files.
MANY = "PROGRAM Main\n  VAR\n" + "".join(f"    a_rather_long_name_{n} : DINT;\n" for n in range(2_000)) + "  END_VAR\nEND_PROGRAM\n"


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

    def test_the_clock_is_the_one_that_up_was_told(self):
        cell = self.kept()
        cell.ready("--set", "clock.mode=simulated")
        self.assertTrue(eventually(lambda: self.program(cell) == "running"), cell.status())
        self.assertRegex(cell.run("status").stdout, r"(?m)^  program running \(simulated clock")

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

    def test_a_cell_without_its_program_is_not_called_ready(self):
        cell = self.kept(program=MANY)
        self.addCleanup(cell.run, "down")
        up = cell.run("up", "--detach", "--set", "runtime.memory_limit_mb=1")
        self.assertEqual(up.returncode, 5, up.stdout + up.stderr)
        self.assertRegex(up.stderr, r"the cell '[\w-]+' is up without its program: .*R0076: ")
        self.assertRegex(up.stderr, r"its page is http")
        self.assertNotIn("is ready", up.stderr)
        status = cell.run("status")
        self.assertEqual(status.returncode, 5, status.stdout)
        self.assertRegex(status.stdout, r"(?m)^  program empty \(real clock\): .*R0076: ")


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

    def filled_after_a_run(self, *options):
        """A cell that has run before; then its disk was filled by something else."""
        need_mounts()
        cell = KeptCell()
        self.addCleanup(cell.__exit__)
        mount(cell.state, *options)
        self.addCleanup(unmount, cell.state)
        self.assertEqual(cell.run("up", "--detach").returncode, 0)
        self.assertEqual(cell.run("down").returncode, 0)
        fill(cell.state)
        for each in cell.state.glob("file*"):
            each.unlink()
        return cell

    def test_a_program_of_the_same_sources_runs(self):
        cell = self.filled_after_a_run("size=2m", "nr_inodes=128")
        kept = (cell.state / "program.swb").read_bytes()
        done = cell.run("up", "--detach")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual((cell.state / "program.swb").read_bytes(), kept)
        self.assertTrue(eventually(lambda: cell.status()["program"]["state"] == "running"), cell.status())
        self.assertEqual(cell.run("down").returncode, 0)

    def test_a_program_that_cannot_be_kept_is_told_as_that(self):
        cell = self.filled_after_a_run("size=2m", "nr_inodes=128")
        (cell.folder / "main.st").write_text(MANY, encoding="utf-8")
        done = cell.run("up", "--detach")
        self.assertEqual(done.returncode, 5, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"program\.swb: E0002: the sources compile, and their program cannot be kept: .*No space left on device\n  hint: the disk is full")
        self.assertNotIn("does not compile", done.stderr)
        self.assertIn("is not up", cell.run("status").stdout)

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
