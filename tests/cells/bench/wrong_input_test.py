"""Wrong input: a clear message with its place, the right exit code, nothing half-applied."""

import json
import pathlib
import shutil
import socket
import tempfile
import unittest

from cell_process import stepwright

CELL = pathlib.Path(__file__).parent


class WrongInput(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        for name in ("cell.toml", "binding.toml", "domain.pddl", "problem.pddl"):
            shutil.copy(CELL / name, self.folder)
        shutil.copytree(CELL / "plans", self.folder / "plans")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def change(self, name, old, new):
        file = self.folder / name
        text = file.read_text(encoding="utf-8")
        self.assertIn(old, text)
        file.write_text(text.replace(old, new, 1), encoding="utf-8")
        return file

    def plan(self, *options):
        return stepwright("plan", self.folder / "domain.pddl", self.folder / "problem.pddl", *options)

    def demo(self, *options):
        return stepwright("demo", self.folder / "cell.toml", "--headless", "--fast", "--no-compare", *options)

    def test_malformed_pddl(self):
        self.change("domain.pddl", "(is-at ?v ?f)", "(is-att ?v ?f)")
        result = self.plan()
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"domain\.pddl:\d+:\d+: P\d+: .*is-att")
        self.assertIn("is-at", result.stderr.split("hint", 1)[1])

    def test_what_pddl_has_and_this_planner_has_not(self):
        for name, old, new, expected in (
            ("domain.pddl", "(:action load", "(:durative-action load",
             r"domain\.pddl:\d+:\d+: P0008: .*:durative-action"),
            ("domain.pddl", "vehicle place client leveltransf - object", "vehicle place client leveltransf - place",
             r"domain\.pddl:7:13: P0109: .*'place'"),
            ("problem.pddl", "(* 50 (postponed))", "(/ (postponed) 0)",
             r"problem\.pddl:\d+:\d+: P0117: .*zero"),
        ):
            self.setUp()
            self.change(name, old, new)
            result = self.plan()
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertRegex(result.stderr, expected)
            self.assertNotIn("(load", result.stdout)

    def test_unreachable_goal_and_its_reason(self):
        file = self.change("problem.pddl", "(= (level a1) 5)", "(= (level a1) 11)")
        line = next(i for i, text in enumerate(file.read_text().splitlines(), 1) if "(= (level a1) 11)" in text)
        result = self.plan()
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertRegex(result.stderr, rf"problem\.pddl:{line}:\d+: P0501: .*\(level a1\) stays between 2 and 10")

    def test_wrong_plans(self):
        for text, code, expected in (
            ("(load v1 f1 level8)\n(moove v1 f1 a1)\n", 1, r"wrong\.plan:2: P0301: .*moove(.|\n)*hint: .*move"),
            ("(load v1 f1)\n", 1, r"wrong\.plan:1: P0302: "),
            ("(load v1 f1 level9)\n", 1, r"wrong\.plan:1: P0305: .*\(lev v1\) = 2"),
            ("(load v1 f1 level8\n", 1, r"wrong\.plan:1:\d+: P0404: "),
            ("(load v1 f1 level8)\n", 1, r"wrong\.plan: P0310: "),
        ):
            plan = self.folder / "wrong.plan"
            plan.write_text(text, encoding="utf-8")
            result = stepwright("validate", self.folder / "domain.pddl", self.folder / "problem.pddl", plan)
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertRegex(result.stderr, expected)
        self.assertEqual(stepwright("validate", self.folder / "domain.pddl").returncode, 2)

    def test_unsolvable_problem(self):
        self.change("problem.pddl", "(= (level a1) 5)", "(= (level a1) 11)")
        for result in (self.plan(), self.demo()):
            self.assertEqual(result.returncode, 3, result.stderr)
            self.assertIn("(= (level a1) 11)", result.stdout + result.stderr)

    def test_binding_with_an_unknown_tag(self):
        self.change("binding.toml", 'outputs = ["B1"]', 'outputs = ["B7"]')
        result = self.demo()
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"binding\.toml:\d+:\d+: B\d+: .*B7")

    def test_binding_with_an_unknown_action(self):
        self.change("binding.toml", "(load ?v ?f ?l)", "(lode ?v ?f ?l)")
        result = stepwright("check", "--config", self.folder / "cell.toml")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"binding\.toml:\d+:\d+: B\d+: .*lode")

    def test_configuration_with_a_slip(self):
        self.change("cell.toml", "speed = 10.0", "sped = 10.0")
        result = self.demo()
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"cell\.toml:\d+:\d+: C0002: .*sped")
        self.assertIn("did you mean 'speed'", result.stderr)

    def test_configuration_with_a_wrong_wire(self):
        self.change("cell.toml", 'B1 = "%QX0.0"', 'B1 = "%QX9000.0"')
        result = self.demo()
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"cell\.toml:\d+:\d+: C0303: %QX9000\.0")

    def test_missing_cell(self):
        result = stepwright("demo", "banch", "--headless")
        self.assertEqual(result.returncode, 1)
        self.assertIn("there is no cell 'banch'", result.stderr)
        self.assertIn("bench", result.stderr.split("known cells", 1)[1])

    def test_port_in_use(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            result = stepwright("demo", "bench", "--fast", "--no-compare", "--port", port)
        self.assertEqual(result.returncode, 1)
        self.assertIn(str(port), result.stderr)
        self.assertIn("in use", result.stderr)

    def test_plan_that_fails_at_a_step(self):
        result = stepwright("validate", self.folder / "domain.pddl", self.folder / "problem.pddl",
                            self.folder / "plans" / "sgplan6_printed.plan")
        self.assertEqual(result.returncode, 1)
        self.assertIn("18", result.stdout + result.stderr)

    def test_damaged_container(self):
        source = self.folder / "main.st"
        source.write_text("PROGRAM main VAR x : INT; END_VAR x := x + 1; END_PROGRAM\n", encoding="utf-8")
        image = self.folder / "main.swb"
        self.assertEqual(stepwright("compile", source, "-o", image).returncode, 0)
        good = image.read_bytes()
        self.assertEqual(stepwright("exec", image, "--scans", 3).returncode, 0)
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 4
        for bad in (good[: len(good) // 2], bytes(flipped), b"", b"not a container"):
            image.write_bytes(bad)
            result = stepwright("exec", image, "--scans", 3)
            self.assertEqual(result.returncode, 1)
            self.assertIn("main.swb", result.stderr)

    def test_wrong_command_line(self):
        for arguments in (["plann"], ["plan"], ["demo", "bench", "--headless", "--fault", "leak"], []):
            self.assertEqual(stepwright(*arguments).returncode, 2, arguments)

    def test_override_that_is_none(self):
        for text in ("#plant.seed=1", "=1"):
            result = self.demo("--set", text)
            self.assertEqual(result.returncode, 1, text)
            self.assertIn("C0001", result.stderr)

    def test_pictures_that_cannot_be_written(self):
        result = self.demo("--pictures", "/proc/pictures")
        self.assertEqual(result.returncode, 1)
        self.assertIn("/proc/pictures/gantt.svg: M0005", result.stderr)

    def test_report_of_an_earlier_run_is_not_taken_for_this_one(self):
        kept = ("--state-dir", self.folder / "state", "--json", self.folder / "report.json")
        self.assertEqual(self.demo(*kept).returncode, 0)
        self.change("binding.toml", 'outputs = ["B1"]', 'outputs = ["B7"]')
        self.assertEqual(self.demo(*kept).returncode, 1)
        self.assertNotIn("goal_reached", json.loads((self.folder / "report.json").read_text(encoding="utf-8")))

    def test_unknown_fault(self):
        report = self.folder / "report.json"
        result = self.demo("--fault", "leek_a1=1@5", "--json", report)
        self.assertEqual(result.returncode, 1)
        self.assertIn("leak_a1", result.stderr + json.dumps(report.read_text() if report.exists() else ""))


if __name__ == "__main__":
    unittest.main()
