"""Controllers that fall silent, come back, and lose their power in the middle of a plan."""

import time
import unittest

from cell_process import Demo
from controllers import Controller, eventually, log_of

# Slow enough that the plan is under way when something happens to it; so patient that only what does not answer is lost.
SLOW = ("--no-compare", "--set", "clock.speed=20", "--set", "controller.lost_after_ms=3000")


class Loss(unittest.TestCase):
    def test_a_silent_controller_ends_the_plan(self):
        with Controller() as controller, Demo(*SLOW, "--controller", controller.where) as demo:
            demo.wait_for_actions(3)
            controller.silence()
            report, code = demo.result()
            self.assertEqual(code, 5, report["stdout"])
            self.assertFalse(report["goal_reached"])
            self.assertIn("lost while it ran", report["message"])
            self.assertIn("R0141", log_of(demo, "gateway"))

    def test_a_short_silence_changes_nothing_but_the_time_it_takes(self):
        with Demo("--fast", "--no-compare") as demo:
            host, _ = demo.result()
        with Controller() as controller:
            patient = ("--set", "controller.lost_after_ms=60000", "--set", "controller.timeout_ms=50")
            with Demo("--no-compare", "--set", "clock.speed=50", *patient, "--controller", controller.where) as demo:
                demo.wait_for_actions(2)
                controller.silence()
                time.sleep(0.5)
                controller.speak()
                report, code = demo.result()
                self.assertEqual(code, 0, report["stdout"])
                self.assertEqual(report["trace_hash"], host["trace_hash"])

    def test_a_controller_that_loses_its_power_is_not_taken_for_the_one_before(self):
        with Controller() as controller, Demo(*SLOW, "--controller", controller.where) as demo:
            demo.wait_for_actions(2)
            controller.lose_power()
            report, code = demo.result()
            self.assertEqual(code, 5, report["stdout"])
            self.assertIn("lost while it ran", report["message"])
            self.assertTrue(eventually(lambda: "R0143" in log_of(demo, "gateway")))


if __name__ == "__main__":
    unittest.main()
