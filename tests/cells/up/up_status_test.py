"""`stepwright status` tells how the program is, not only its processes; `up` with a disk that is full says so."""

import pathlib
import re
import shutil
import signal
import tempfile
import unittest

from kept_cell import DEVICES, NO_PLANT, PAGE, PROGRAM, RUNS, KeptCell
from mounts import empty, fill, mount, need_mounts, unmount
from processes import eventually, stepwright

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
        cell.up().wait_for(r"the cell '.*' is (ready: http|up and its program is in fault: .*zero)")
        self.assertTrue(eventually(lambda: self.program(cell) == "fault"), cell.status())
        status = cell.run("status")
        self.assertEqual(status.returncode, 5, status.stdout)
        self.assertRegex(status.stdout, r"(?m)^  program fault \(real clock\): .*zero")
        record = cell.status()
        self.assertEqual({each["phase"] for each in record["processes"]}, {"ready"})
        self.assertEqual(record["program"]["mode"], "real clock")
        self.assertIn("zero", record["program"]["detail"])

    def test_a_cell_that_is_in_fault_when_all_run_is_not_called_ready(self):
        needed = DEVICES.replace('address = "%QX0.0", coil = 0', 'address = "%IX0.0", discrete = 0').replace("sources", "autostart = true\nsources")
        cell = self.kept(more=needed, program=PROGRAM.replace("lamp AT %QX0.0", "lamp AT %IX0.0").replace("  lamp := TRUE;\n", ""))
        self.addCleanup(cell.run, "down")
        up = cell.run("up", "--detach")
        self.assertEqual(up.returncode, 5, up.stdout + up.stderr)
        self.assertRegex(up.stderr, r"the cell '[\w-]+' is up and its program is in fault: .")
        self.assertEqual(cell.run("status").returncode, 5)

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


class NotKnown(unittest.TestCase):
    """A cell that is up, of which its state folder says nothing any more."""

    def kept(self):
        cell = KeptCell()
        self.addCleanup(cell.__exit__)
        return cell, cell.ready()

    def ended(self, cell, up):
        done = cell.run("down")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"process {up.pid} kept it up", done.stdout)
        self.assertEqual(up.wait(), 0, up.output())
        self.assertIn("is down", up.output())

    def test_a_state_folder_that_was_removed_hides_nothing(self):
        cell, up = self.kept()
        shutil.rmtree(cell.state)
        status = cell.run("status")
        self.assertEqual(status.returncode, 5, status.stdout)
        self.assertRegex(status.stderr, rf"M0024: process {up.pid} keeps this cell up")
        other = cell.run("down", "--set", "cell.name=other")
        self.assertEqual((other.returncode, other.stdout), (0, "cell 'other' is not up\n"), "another cell of the same file")
        self.ended(cell, up)
        self.assertIn("is not up", cell.run("down").stdout)

    def test_a_file_that_cannot_be_read_any_more_keeps_nobody_from_ending_the_cell(self):
        cell, up = self.kept()
        cell.config.write_text(cell.config.read_text(encoding="utf-8") + "[clock\n", encoding="utf-8")
        status = cell.run("status")
        self.assertEqual(status.returncode, 5, status.stdout)
        self.assertIn("C0001", status.stderr)
        self.assertIn("M0024", status.stderr)
        self.ended(cell, up)
        self.assertEqual(cell.run("down").returncode, 1)

    def test_a_terminal_that_is_closed_ends_the_cell_in_order(self):
        cell, up = self.kept()
        up.send(signal.SIGHUP)
        self.assertEqual(up.wait(), 0, up.output())
        self.assertRegex(up.output(), r"(?s)ends hmi.*ends runtime.*is down")
        self.assertFalse((cell.state / "up.json").exists())

    def test_a_folder_is_no_cell_and_its_cell_is_named(self):
        with tempfile.TemporaryDirectory(prefix="stepwright-test-") as folder:
            for command in ("up", "check", "status"):
                done = stepwright(command, folder)
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"{folder}: M0012: this is a folder, and no cell", done.stderr)
                self.assertIn("stepwright new", done.stderr)
            pathlib.Path(folder, "cell.toml").write_text("", encoding="utf-8")
            self.assertIn(f"did you mean '{folder}/cell.toml'?", stepwright("check", folder).stderr)


class FullDisk(unittest.TestCase):
    def test_a_history_that_finds_no_room_is_told_while_it_lasts_and_at_the_end(self):
        need_mounts()
        cell = KeptCell(more=NO_PLANT + RUNS + PAGE + '[history]\nfolder = "history"\n')
        self.addCleanup(cell.__exit__)
        mount(cell.state, "size=4m", "nr_inodes=64")
        self.addCleanup(unmount, cell.state)
        up = cell.ready()
        fill(cell.state)
        up.wait_for("nothing can be recorded: .*S0003")
        empty(cell.state)
        up.wait_for("values and alarms are recorded again")
        fill(cell.state)
        self.assertTrue(eventually(lambda: len(re.findall("nothing can be recorded", up.output())) == 2), up.output())
        up.end()
        self.assertRegex(up.output(), "what was recorded last is lost: .*S0003")

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
