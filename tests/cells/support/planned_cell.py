"""A planned cell on a simulated plant, as a user has it: checked, tried, run to its goal, disturbed."""

import json
import pathlib
import shutil
import tempfile

from processes import SOURCES, stepwright

CELLS = SOURCES / "tests/cells"


class PlannedCell:
    """A copy of a cell's folder, whose files a test may change."""

    def __init__(self, source):
        self.temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.folder = pathlib.Path(self.temporary.name) / "cell"
        shutil.copytree(source, self.folder)
        self.file = self.folder / "cell.toml"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.temporary.cleanup()

    def change(self, file, old, new, times=1):
        """Replaces a text that must be there."""
        path = self.folder / file
        text = path.read_text(encoding="utf-8")
        if old not in text:
            raise AssertionError(f"{file} has no {old!r}")
        path.write_text(text.replace(old, new, times), encoding="utf-8")

    def check(self):
        return stepwright("check", "--config", self.file, cwd=self.folder)

    def attempt(self, *arguments):
        """`binding try`: the command, and what it found."""
        found = self.folder / "tried.json"
        found.unlink(missing_ok=True)
        done = stepwright("binding", "try", self.file, "--json", found, *arguments, cwd=self.folder)
        return done, json.loads(found.read_text(encoding="utf-8")) if found.exists() else None

    def demo(self, *arguments):
        """The run of its main job, and its report."""
        report = self.folder / "report.json"
        report.unlink(missing_ok=True)
        done = stepwright("demo", self.file, "--headless", "--fast", "--no-compare", "--json", report, "--state-dir",
                          self.folder / "state", *arguments, cwd=self.folder)
        return done, json.loads(report.read_text(encoding="utf-8")) if report.exists() else None


class CellOfThisTree:
    """What every one of the cells keeps; mixed into a TestCase that has NAME and FAULTS."""

    def setUp(self):
        self.cell = PlannedCell(CELLS / self.NAME)
        self.addCleanup(self.cell.__exit__)

    def test_it_is_sound_and_its_binding_does_what_it_says(self):
        checked = self.cell.check()
        self.assertEqual((checked.returncode, [line for line in checked.stderr.splitlines() if "C0559" not in line and line]), (0, []))
        done, tried = self.cell.attempt("--most", "4")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(tried["diagnostics"], [])
        self.assertGreater(sum(each["runs"] for each in tried["actions"]), 6)

    def test_it_reaches_its_goal(self):
        done, report = self.cell.demo()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 0, report["message"])

    def test_a_disturbed_run_ends_in_its_goal_or_in_the_safe_state_with_a_cause(self):
        """Each fault at some time of the job, with a seed of its own: nothing else may come of it."""
        for seed, fault in enumerate(self.FAULTS, 11):
            with self.subTest(fault=fault):
                done, report = self.cell.demo("--seed", str(seed), "--fault", fault)
                self.assertIn(done.returncode, (0, 5), done.stdout + done.stderr)
                self.assertEqual(report["goal_reached"], done.returncode == 0)
                if done.returncode == 5:
                    self.assertTrue(report["message"])
                    self.assertTrue(report["record"]["incidents"], "a stop has an incident, and that its evidence")
