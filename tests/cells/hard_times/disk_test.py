"""A full disk and one that can only be read: what the user sees, and what runs goes on."""

import json
import unittest

from mounts import empty, fill, make_read_only, mount, need_mounts, remount, unmount
from processes import NO_PLANT, Cell, eventually, stepwright

REAL = NO_PLANT + '[clock]\nmode = "real"\n'


class Disk(unittest.TestCase):
    def cell(self, more=REAL, *options):
        """A cell whose state folder is a file system of its own."""
        need_mounts()
        cell = Cell(more)
        self.addCleanup(cell.__exit__)
        mount(cell.state, *(options or ("size=64k", "nr_inodes=32")))
        self.addCleanup(unmount, cell.state)
        return cell

    def scans_go_on(self, cell):
        before = cell.figure("stepwright_scans_total")
        self.assertTrue(eventually(lambda: cell.figure("stepwright_scans_total") > before + 100))

    def test_a_full_disk_at_the_start_is_named(self):
        cell = self.cell()
        fill(cell.state)
        runtime = cell.start("runtime")
        self.assertEqual(runtime.wait(), 1)
        self.assertRegex(runtime.output(), r"state/runtime\.sock: R\d+: .*No space left on device")

    def test_a_disk_that_fills_while_it_runs_costs_nothing(self):
        cell = self.cell()
        runtime = cell.start_runtime()
        cell.load(1_000)
        fill(cell.state)
        self.scans_go_on(cell)
        cell.load(2_000)  # another program, too: none of it needs the disk
        self.scans_go_on(cell)
        self.assertEqual(runtime.end(), 0)

    def test_a_program_that_the_disk_refuses_is_told_and_kept_when_there_is_room(self):
        cell = self.cell(REAL + "[runtime]\nboot = true\n")
        cell.start_runtime()
        first, second = (self.program(cell, name) for name in ("first", "second"))
        self.assertEqual(self.download(cell, first).returncode, 0)
        kept = cell.state / "boot.swb"
        self.assertEqual(kept.read_bytes(), first.read_bytes())  # when it is answered, not later
        fill(cell.state)
        told = self.download(cell, second)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertRegex(told.stderr, r"R0027: the program is not kept for the next start: .*No space left on device")
        self.assertEqual(cell.figure("stepwright_warnings"), 1)
        self.assertEqual(kept.read_bytes(), first.read_bytes())
        empty(cell.state)
        self.assertTrue(eventually(lambda: kept.read_bytes() == second.read_bytes()))
        self.assertTrue(eventually(lambda: cell.figure("stepwright_warnings") == 0))

    def program(self, cell, name):
        source, image = cell.folder / f"{name}.st", cell.folder / f"{name}.swb"
        source.write_text(f"PROGRAM {name}\nVAR x : INT; END_VAR\nx := x + 1;\nEND_PROGRAM\n", encoding="utf-8")
        done = stepwright("compile", source, "-o", image)
        self.assertEqual(done.returncode, 0, done.stderr)
        return image

    def download(self, cell, image):
        return stepwright("download", image, "--config", cell.config, "--replace")

    def test_a_log_on_a_full_disk_loses_lines_and_nothing_else(self):
        cell = self.cell(REAL + '[log]\nformat = "json"\nfile = "state/cell.log"\nlimit_per_s = 1000\n')
        runtime = cell.start("runtime")
        self.assertTrue(eventually(cell.served))
        cell.load(1_000)
        fill(cell.state)
        for _ in range(30):  # more than its last page still has room for
            cell.load(1_000, "hello")
        self.scans_go_on(cell)
        self.assertTrue(eventually(lambda: "No space left on device" in runtime.output()), runtime.output())
        self.assertEqual(runtime.end(), 0)
        # What was written before is whole.
        lines = (cell.state / "cell.log").read_text(encoding="utf-8").splitlines()
        self.assertEqual(json.loads(lines[0])["kind"], "listens")

    def test_figures_that_cannot_be_written_leave_the_old_ones(self):
        cell = self.cell(REAL, "size=256k", "nr_inodes=32")
        cell.start_runtime()
        out = cell.state / "metrics.prom"
        self.assertEqual(stepwright("metrics", "--config", cell.config, "-o", out).returncode, 0)
        old = out.read_text(encoding="utf-8")
        fill(cell.state)
        failed = stepwright("metrics", "--config", cell.config, "-o", out)
        self.assertEqual(failed.returncode, 1)
        self.assertRegex(failed.stderr, r"metrics\.prom: E0002: ")
        self.assertEqual(out.read_text(encoding="utf-8"), old)

    def test_a_read_only_file_system_at_the_start_is_named(self):
        cell = self.cell(REAL, "size=64k")
        remount(cell.state, "ro")
        runtime = cell.start("runtime")
        self.assertEqual(runtime.wait(), 1)
        self.assertRegex(runtime.output(), r"state/runtime\.sock: R\d+: .*Read-only file system")

    def test_a_state_folder_that_cannot_be_made_is_named(self):
        need_mounts()
        cell = Cell('[plant]\nkind = "none"\n')
        self.addCleanup(cell.__exit__)
        box = cell.folder / "box"
        mount(box, "size=64k")
        self.addCleanup(unmount, box)
        remount(box, "ro")
        text = cell.config.read_text(encoding="utf-8").replace('"state"', '"box/state"')
        cell.config.write_text(text, encoding="utf-8")
        runtime = cell.start("runtime")
        self.assertEqual(runtime.wait(), 1)
        self.assertRegex(runtime.output(), r"box/state: R0078: the state folder cannot be made: Read-only file system")

    def test_a_file_system_that_becomes_read_only_costs_nothing(self):
        cell = self.cell(REAL, "size=64k")
        runtime = cell.start_runtime()
        cell.load(1_000)
        make_read_only(cell.state)
        self.addCleanup(unmount, cell.state)
        self.scans_go_on(cell)
        self.assertEqual(runtime.end(), 0)


if __name__ == "__main__":
    unittest.main()
