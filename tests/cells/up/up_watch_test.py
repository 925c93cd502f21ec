"""`stepwright up --watch`: what is saved takes over while the program runs, or it is said why not."""

import re
import unittest

from kept_cell import NO_PLANT, PAGE, PROGRAM, RUNS, KeptCell
from processes import eventually, stepwright


class Watch(unittest.TestCase):
    def kept(self, **options):
        cell = KeptCell(**options)
        self.addCleanup(cell.__exit__)
        return cell

    def value(self, cell, name):
        found = re.search(rf"{re.escape(name)} = (\S+)", stepwright("snapshot", "--config", cell.config, name).stdout)
        return found.group(1) if found else None

    def test_what_is_saved_takes_over_and_is_kept(self):
        cell = self.kept()
        process = cell.ready("--watch")
        self.assertTrue(eventually(lambda: int(self.value(cell, "Main.n") or 0) > 100))
        (cell.folder / "main.st").write_text(PROGRAM.replace("n : UDINT;", "n : UDINT; more : INT := 7;"), encoding="utf-8")
        process.wait_for("brought in: what was saved runs")
        self.assertTrue(eventually(lambda: self.value(cell, "Main.more") == "7"))
        self.assertGreater(int(self.value(cell, "Main.n")), 100, "values go on")
        self.assertIn(b"more", (cell.state / "program.swb").read_bytes())

    def test_what_does_not_compile_is_told_and_the_program_goes_on(self):
        cell = self.kept()
        process = cell.ready("--watch")
        (cell.folder / "main.st").write_text(PROGRAM.replace("n + 1", "m + 1"), encoding="utf-8")
        process.wait_for("not brought in: the sources are wrong")
        process.wait_for(r"(?m)^watch +\| .*main\.st:3:8: .*E\d{4}")
        before = int(self.value(cell, "Main.n"))
        self.assertTrue(eventually(lambda: int(self.value(cell, "Main.n")) > before))
        (cell.folder / "main.st").write_text(PROGRAM.replace("n + 1", "n + 2"), encoding="utf-8")
        process.wait_for("brought in: what was saved runs")

    # The divisor is 0 in the fifth scan behind the swap: within the trial.
    def test_what_traps_on_trial_is_not_said_to_run(self):
        cell = self.kept()
        process = cell.ready("--watch")
        trapping = PROGRAM.replace("n : UDINT;", "n : UDINT; left : INT := 5; q : INT;").replace("lamp :=", "left := left - 1; q := 100 / left; lamp :=")
        (cell.folder / "main.st").write_text(trapping, encoding="utf-8")
        process.wait_for(r"R0040: it trapped on trial: .*; the program before goes on")
        process.wait_for("not brought in: `stepwright status` says what is")
        self.assertNotIn("brought in: what was saved runs", process.output().replace("not brought in", ""))
        before = int(self.value(cell, "Main.n"))
        self.assertTrue(eventually(lambda: int(self.value(cell, "Main.n")) > before))
        self.assertNotIn(b"left", (cell.state / "program.swb").read_bytes())

    def test_a_mended_program_takes_over_after_a_fault(self):
        trapping = PROGRAM.replace("n : UDINT;", "n : UDINT; left : INT := 60; q : INT;").replace("lamp :=", "left := left - 1; q := 100 / left; lamp :=")
        cell = self.kept(program=trapping)
        process = cell.ready("--watch")
        self.assertTrue(eventually(lambda: "fault" in cell.run("status").stdout))
        (cell.folder / "main.st").write_text(PROGRAM, encoding="utf-8")
        process.wait_for("brought in: what was saved runs")
        self.assertRegex(process.output(), r"(?m)^watch +\| [0-9a-f]{12} is loaded$", "it is started, and not stopped")
        before = int(self.value(cell, "Main.n"))
        self.assertTrue(eventually(lambda: int(self.value(cell, "Main.n")) > before))

    def test_a_stopped_program_is_replaced_and_the_command_that_starts_it_is_told(self):
        cell = self.kept()
        process = cell.ready("--watch")
        self.assertEqual(stepwright("stop", "--config", cell.config).returncode, 0)
        (cell.folder / "main.st").write_text(PROGRAM.replace("n + 1", "n + 2"), encoding="utf-8")
        process.wait_for("the program before was stopped: `stepwright start --config ")
        process.wait_for("brought in, and not known to run")
        self.assertEqual(stepwright("start", "--config", cell.config).returncode, 0)
        self.assertTrue(eventually(lambda: int(self.value(cell, "Main.n") or 0) > 0))

    def test_what_names_a_removed_variable_is_in_the_log(self):
        cell = self.kept(more=NO_PLANT + RUNS + PAGE + 'recipes = "recipes.toml"\n', program=PROGRAM.replace("n : UDINT;", "n : UDINT; level : INT;"))
        (cell.folder / "recipes.toml").write_text('[[tag]]\nname = "Main.level"\ntype = "INT"\nmin = 0\nmax = 9\n', encoding="utf-8")
        screens = cell.state / "screens"
        screens.mkdir(parents=True, mode=0o700)
        (screens / "Mixer.svg").write_text('<svg viewBox="0 0 9 9"><text data-text="Main.level">-</text><text data-text="Main.n">-</text></svg>\n', encoding="utf-8")
        cell.state.chmod(0o700)
        process = cell.ready("--watch")
        self.assertNotIn("has no variable", process.output())
        (cell.folder / "main.st").write_text(PROGRAM, encoding="utf-8")
        process.wait_for("brought in: what was saved runs")
        process.wait_for("the program has no variable 'Main.level', which recipes set: no recipe can be loaded")
        process.wait_for("the screen 'Mixer' names 'Main.level', which the program does not have any more")

    def test_a_source_that_is_gone_and_a_saved_configuration_are_told(self):
        cell = self.kept()
        process = cell.ready("--watch")
        (cell.folder / "main.st").rename(cell.folder / "aside.st")
        process.wait_for(r"(?m)^watch +\| main\.st is gone: the program before goes on")
        (cell.folder / "aside.st").rename(cell.folder / "main.st")
        process.wait_for("a source was saved: compiles")
        process.wait_for("brought in: what was saved runs")
        cell.config.write_text(cell.config.read_text(encoding="utf-8") + "# changed\n", encoding="utf-8")
        process.wait_for(r"(?m)^watch +\| cell\.toml was saved: it counts from the next start on\. `stepwright check ")
        before = int(self.value(cell, "Main.n"))
        self.assertTrue(eventually(lambda: int(self.value(cell, "Main.n")) > before))

    def test_a_cell_without_sources_cannot_be_watched(self):
        cell = self.kept(more=NO_PLANT + PAGE)
        done = cell.run("up", "--watch")
        self.assertEqual(done.returncode, 2)
        self.assertIn("M0017", done.stderr)


if __name__ == "__main__":
    unittest.main()
