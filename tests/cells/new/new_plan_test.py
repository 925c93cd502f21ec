"""`stepwright new NAME --plan`: the cell is sound, its binding does what it says, it runs to its goal, and to another one
that the page sets."""

import json
import pathlib
import re
import tempfile
import unittest

from namespaces import need_network_of_its_own
from page import PASSWORD, Page
from processes import eventually, stepwright

FILES = {"README.md", "alarms.toml", "binding.toml", "cell.toml", "domain.pddl", "plant.toml", "problem.pddl"}


class Operator(Page):
    """Who logs in at the page of a cell that is up."""

    def __init__(self, said):  # pylint: disable=super-init-not-called
        self.tls, self.cookie, self.csrf = False, "", ""
        self.scheme, self.host = "http", "127.0.0.1"
        self.port = int(re.search(r"http://127\.0\.0\.1:(\d+)/", said).group(1))
        token = re.search(r"set-up token ([A-Z2-9-]{24})", said).group(1)
        answer = self.ask("POST", "/api/setup", {"token": token, "name": "root", "password": PASSWORD})
        assert answer.status == 200, answer.json


class NewPlan(unittest.TestCase):
    def setUp(self):
        need_network_of_its_own()
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)
        made = stepwright("new", "batch", "--plan", cwd=self.root)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.folder = self.root / "batch"

    def record(self):
        journal = self.folder / "state/executive.json"
        return json.loads(journal.read_text(encoding="utf-8"))["record"] if journal.exists() else {"phase": ""}

    def test_it_is_sound(self):
        self.assertEqual({path.name for path in self.folder.iterdir()}, FILES)
        for path in self.folder.iterdir():
            self.assertNotIn("{{", path.read_text(encoding="utf-8"), path)
        checked = stepwright("check", cwd=self.folder)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertEqual([line for line in checked.stderr.splitlines() if line and "C0559" not in line], [])
        self.assertIn("plan: 6 actions", checked.stdout)

    def test_it_runs_to_its_goal_and_to_one_of_the_page(self):
        done = stepwright("up", "--detach", "--port", 0, "--set", "clock.speed=0", cwd=self.folder)
        self.addCleanup(stepwright, "down", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        reaches = lambda phase: eventually(lambda: self.record()["phase"] == phase)
        self.assertTrue(reaches("done"))
        self.assertAlmostEqual(self.record()["observed"]["(product)"], 50, delta=2)
        page = Operator(done.stdout)
        start = lambda: page.ask("POST", "/api/plan/start", {"goal": "(= (product) 90)", "reason": "more is wanted"}).status == 200
        self.assertTrue(eventually(start))
        self.assertTrue(eventually(lambda: self.record()["phase"] == "done" and self.record()["observed"]["(product)"] > 80))
        self.assertAlmostEqual(self.record()["observed"]["(product)"], 90, delta=2)

    def test_it_excludes_what_is_no_plan(self):
        for others in (("--plant", "tanks"), ("--from", "plc.xml")):
            self.assertEqual(stepwright("new", "other", "--plan", *others, cwd=self.root).returncode, 2)


if __name__ == "__main__":
    unittest.main()
