"""doc/plan-your-plant.md: its commands, all of them and in order; what it promises of them; a goal from the page."""

import json
import unittest

from guide_pages import MOST_LINES, Guide, blocks, page
from processes import eventually, get


class PlanYourPlant(Guide):
    def report(self, folder, name):
        return json.loads((folder / name).read_text(encoding="utf-8"))

    def test_every_command_works_in_its_order(self):
        text = page("plan-your-plant.md")
        self.assertLessEqual(len(text.splitlines()), MOST_LINES)
        *before, down, faults = blocks(text)
        self.ends_with_the_test("batch/cell.toml")
        said = self.bash("".join(before) + "\n", self.root)
        folder = self.root / "batch"
        self.assertIn("problem", said)
        tried = self.report(folder, "tried.json")
        self.assertTrue(tried["sound"])
        self.assertEqual(tried["diagnostics"], [])
        self.assertEqual({each["action"].split()[0] for each in tried["actions"]}, {"(fill", "(heat", "(empty"})
        report = self.report(folder, "report.json")
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 0)
        rows = (folder / "fill.csv").read_text(encoding="utf-8").splitlines()
        self.assertGreater(float(rows[-1].split(",")[1]), 20, "percent of the vessel")
        self.assertTrue(json.loads(self.bash("stepwright status --json", folder))["ready"])
        self.assertEqual(get(8080, "/")[0].status, 200)
        self.assertTrue(eventually(lambda: json.loads(get(8080, "/api/alarms")[1])["figures"]["no_variable"] == 0))
        self.bash(down, folder)
        self.bash(faults, folder)
        self.assertTrue(self.report(folder, "weak.json")["goal_reached"], "a weak pump is slow, and brings it all the same")
        cold = self.report(folder, "cold.json")
        self.assertFalse(cold["goal_reached"])
        self.assertIn("heater", cold["message"])


if __name__ == "__main__":
    unittest.main()
