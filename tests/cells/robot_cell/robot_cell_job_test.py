#!/usr/bin/env python3
"""The cell of two arms with all its real processes. The judges are the camera, and the plant: who touched whom, what fell."""

import pathlib
import shutil
import tempfile
import unittest

from cell_process import Demo, stepwright

CELL = pathlib.Path(__file__).parent
KEYS = """goal_reached plan_steps plan_cost first_plan_ms replans makespan_s planned_makespan_s scans overruns scan_p50_us
scan_p99_us realtime_factor trace_hash processes plant""".split()
CONTACTS = ("contacts_arm_arm", "contacts_arm_fixed", "contacts_arm_object", "contacts_object_object", "contacts_object_fixed")


class RobotCellJob(unittest.TestCase):
    def run_demo(self, *arguments):
        with Demo("--fast", "--no-compare", *arguments, cell="robot_cell") as demo:
            return demo.result()

    def check_clean(self, report, kinds=CONTACTS):
        for kind in kinds:
            self.assertEqual(report["plant"][kind], 0, kind)

    def evidence(self, report):
        return [sentence for incident in report["record"]["incidents"] for sentence in incident["evidence"]]

    def check_in(self, report, thing, x_m, y_m, size_m):
        self.assertLess(abs(report["plant"][f"x_{thing}"] - x_m), 0.5 * size_m)
        self.assertLess(abs(report["plant"][f"y_{thing}"] - y_m), 0.5 * size_m)

    def test_a_cup_changes_hands_and_the_same_seed_gives_the_same_trace(self):
        report, code = self.run_demo()
        self.assertEqual(code, 0, report["stdout"])
        for key in KEYS:
            self.assertIn(key, report)
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 0)
        self.check_clean(report)
        self.check_in(report, "cup1", 0.45, 0.5, 0.2)
        actions = [action["text"] for action in report["record"]["episodes"][0]["actions"]]
        self.assertEqual(actions[0], "right picks cup1")
        self.assertIn("left places cup1 on red-region", actions)
        self.assertEqual(self.run_demo()[0]["trace_hash"], report["trace_hash"])
        self.assertNotEqual(self.run_demo("--seed", "4")[0]["trace_hash"], report["trace_hash"])

    def test_an_order_that_is_asked_for_meanwhile_takes_the_place_of_the_first(self):
        report, code = self.run_demo("--set", 'tamp.requests=[{at_s=6, request="goal", goal="P5"}]')
        self.assertEqual(code, 0, report["stdout"])
        self.assertIn("another order: P5", self.evidence(report))
        for can in ("can1", "can2"):
            self.check_in(report, can, 0.5, -0.27, 0.16)
        self.check_clean(report)

    def test_a_cup_that_falls_is_looked_for_and_picked_up_again(self):
        report, code = self.run_demo("--fault", "drop_right=1@7")
        self.assertIn(code, (0, 5), report["stdout"])
        self.assertIn("cup1", " ".join(self.evidence(report)))
        self.check_clean(report, ("contacts_arm_arm", "contacts_arm_fixed"))

    def test_a_can_that_somebody_moves_is_planned_for_where_it_is(self):
        report, code = self.run_demo("--set", 'tamp.order="P5"', "--fault", "shift_y_can1=-40@2")
        self.assertEqual(code, 0, report["stdout"])
        self.assertIn("can1 was moved: it does not stand where it stood", self.evidence(report))
        self.check_clean(report)
        for can in ("can1", "can2"):
            self.check_in(report, can, 0.5, -0.27, 0.16)

    def test_a_post_that_is_put_into_the_way_is_planned_around(self):
        report, code = self.run_demo("--fault", "block_1=1@2")
        self.assertEqual(code, 0, report["stdout"])
        self.assertRegex(" ".join(self.evidence(report)), r"an obstacle stands in the way, at 0\.\d\d -0\.\d\d m")
        self.assertEqual(report["plant"]["blocked_1"], 1)
        self.check_clean(report)
        self.check_in(report, "cup1", 0.45, 0.5, 0.2)

    def test_a_joint_that_is_stuck_ends_safely_with_the_cause(self):
        report, code = self.run_demo("--fault", "stuck_right_1=1@2")
        self.assertEqual(code, 5, report["stdout"])
        self.assertRegex(report["message"], r"joint 1 of the right arm does not move, .* it is stuck")
        self.check_clean(report)

    def test_a_supervisor_that_is_killed_lets_its_program_go_on(self):
        with Demo("--no-compare", "--set", "clock.speed=10", cell="robot_cell") as demo:
            demo.wait_for_actions(1)
            demo.kill("supervisor")
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.check_clean(report)
        self.assertIn("the supervisor was restarted; what its program has done is looked at", self.evidence(report))

    def check_refused(self, expected, *sets):
        arguments = [part for each in sets for part in ("--set", each)]
        done = stepwright("check", "--config", CELL / "cell.toml", *arguments)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, expected)

    def test_what_is_wrong_is_told_at_its_place(self):
        self.check_refused(r"G0401.*no thing 'cup9'", 'tamp.order="(in cup9 table)"')
        self.check_refused(r"G0401.*no region 'box'", 'tamp.exchange=["box"]')
        self.check_refused(r"there is no order 'P9'", 'tamp.order="P9"')
        self.check_refused(r"G0401.*no order 'P9'", 'tamp.requests=[{at_s=5, request="goal", goal="P9"}]')
        self.check_refused(r"nobody can ask for 'fly'", 'tamp.requests=[{at_s=5, request="fly"}]')
        self.check_refused(r"C0541.*terminal", 'plant.ports.estop_ok="%IX0.0"')
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "robot_cell"
            shutil.copytree(CELL, copy)
            text = (copy / "orders.toml").read_text(encoding="utf-8")
            (copy / "orders.toml").write_text(text.replace("y_m = -0.27", "y_m = -0.2"), encoding="utf-8")
            done = stepwright("check", "--config", copy / "cell.toml")
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"cell\.toml:\d+:\d+.*G0403.*'plate' is another one")


if __name__ == "__main__":
    unittest.main()
