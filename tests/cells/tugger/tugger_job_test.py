#!/usr/bin/env python3
"""The tugger train's cell with all its real processes. The judges are the monitor in the scan and the plant: who ran into
what, and how near anything came."""

import pathlib
import shutil
import tempfile
import unittest

from cell_process import Demo, stepwright

CELL = pathlib.Path(__file__).parent
KEYS = """goal_reached plan_steps plan_cost first_plan_ms replans makespan_s planned_makespan_s scans overruns scan_p50_us
scan_p99_us realtime_factor trace_hash processes plant""".split()


class TuggerJob(unittest.TestCase):
    def run_demo(self, *arguments):
        with Demo("--fast", "--no-compare", *arguments, cell="tugger") as demo:
            return demo.result()

    def check_clean(self, report):
        self.assertEqual(report["plant"]["contacts"], 0)
        self.assertGreater(report["plant"]["smallest_gap"], 0)

    def evidence(self, report):
        return [sentence for incident in report["record"]["incidents"] for sentence in incident["evidence"]]

    def test_the_task_is_done_and_the_same_seed_gives_the_same_trace(self):
        report, code = self.run_demo()
        self.assertEqual(code, 0, report["stdout"])
        for key in KEYS:
            self.assertIn(key, report)
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 0)
        self.assertEqual(report["processes"], ["runtime", "link", "supervisor"])
        self.check_clean(report)
        actions = [action["text"] for action in report["record"]["episodes"][0]["actions"]]
        self.assertEqual(actions[-1], "(stop)")
        self.assertLess(actions.index("(reach press)"), actions.index("(reach rack_a)"))
        self.assertIn("(reach rack_b)", actions)
        self.assertLess(abs(report["makespan_s"] - report["planned_makespan_s"]), 0.15 * report["planned_makespan_s"])
        self.assertEqual(self.run_demo()[0]["trace_hash"], report["trace_hash"])
        self.assertNotEqual(self.run_demo("--seed", "4")[0]["trace_hash"], report["trace_hash"])

    def test_what_stands_in_the_way_is_driven_around(self):
        report, code = self.run_demo("--set", 'ltl.task="visit rack_b"', "--fault", "block_1=1@1")
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.check_clean(report)

    def test_trailers_that_are_left_and_another_task_are_planned_for_from_rest(self):
        report, code = self.run_demo("--fault", "leave_trailers=1@8",
                                     "--set", 'ltl.requests=[{at_s=25, request="goal", goal="visit wash"}]')
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["plant"]["true_trailers"], 1)
        self.check_clean(report)
        evidence = self.evidence(report)
        self.assertIn("1 trailers are coupled, the plan has 3", evidence)
        self.assertIn("another task: visit wash", evidence)

    def test_a_place_out_of_service_is_told_or_waited_for(self):
        report, code = self.run_demo("--set", 'ltl.requests=[{at_s=5, request="block", name="press"}]')
        self.assertEqual(code, 5, report["stdout"])
        self.assertIn("the task cannot be done without 'press'", report["message"])
        report, code = self.run_demo("--set", 'ltl.requests=[{at_s=5, request="block", name="press"}, '
                                     '{at_s=30, request="unblock", name="press"}, {at_s=30, request="resume"}]')
        self.assertEqual(code, 0, report["stdout"])
        self.check_clean(report)

    def test_a_supervisor_that_is_killed_does_the_rest_of_the_task(self):
        with Demo("--no-compare", "--set", "clock.speed=20", cell="tugger") as demo:
            demo.wait_for_actions(1)
            demo.kill("supervisor")
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.check_clean(report)
        self.assertIn("the supervisor was restarted; the train plans from rest", self.evidence(report))

    def test_a_report_that_cannot_be_written_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            state = pathlib.Path(folder) / "state"
            (state / "report.json.part").mkdir(parents=True)  # in the way of the file that becomes the report
            done = stepwright("demo", "tugger", "--headless", "--fast", "--no-compare", "--state-dir", state,
                              "--set", 'ltl.task="visit unload"')
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertRegex(done.stderr, r"E0002: .*\n(.*\n)*.*M0010: the supervisor has ended with 5 and has left no report")

    def check_refused(self, expected, *sets):
        arguments = [part for each in sets for part in ("--set", each)]
        done = stepwright("check", "--config", CELL / "cell.toml", *arguments)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, expected)

    def test_what_is_wrong_is_told_at_its_place(self):
        self.check_refused(r"L0311.*'pres'", 'ltl.task="visit pres"')
        self.check_refused(r"L0011", 'ltl.task="never press"')
        self.check_refused(r"X0003.*no place 'dock'", 'ltl.requests=[{at_s=5, request="block", name="dock"}]')
        self.check_refused(r"nobody can ask for 'fly'", 'ltl.requests=[{at_s=5, request="fly"}]')
        self.check_refused(r"C0541.*terminal", 'plant.ports.x="%IW0"')
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "tugger"
            shutil.copytree(CELL, copy)
            (copy / "hall.json").write_text('{"scene": "nowhere.geojson", "task": "visit a"}', encoding="utf-8")
            done = stepwright("check", "--config", copy / "cell.toml")
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"L0401.*nowhere\.geojson")


if __name__ == "__main__":
    unittest.main()
