"""Processes of the sorting line that are killed: the line stands where it stood, and the order is finished."""

import signal
import unittest

from cell_process import Demo
from sorting_job_test import ORDERED, sorted_boxes


class Kill(unittest.TestCase):
    def run_and_kill(self, program, actions):
        with Demo("--no-compare", "--set", "clock.speed=20", cell="conveyor") as demo:
            demo.wait_for_actions(actions)
            demo.kill(program)
            return demo.result()

    def test_the_runtime_is_killed_and_the_boxes_stay_where_they_are(self):
        report, code = self.run_and_kill("runtime", 7)
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["restarts"], {"runtime": 1})
        self.assertGreaterEqual(report["replans"], 1)
        self.assertEqual(sorted_boxes(report["plant"]), ORDERED)
        self.assertEqual(report["plant"]["collisions"], 0)

    def test_the_supervisor_is_killed_and_goes_on_with_the_plan_that_runs(self):
        report, code = self.run_and_kill("supervisor", 8)
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["restarts"], {"supervisor": 1})
        self.assertEqual(sorted_boxes(report["plant"]), ORDERED)

    def test_a_supervisor_that_its_machine_holds_up_costs_a_simulation_nothing(self):
        with Demo("--fast", "--no-compare", cell="conveyor") as demo:
            undisturbed, _ = demo.result()
        with Demo("--fast", "--no-compare", cell="conveyor") as demo:
            demo.wait_for_actions(2)
            demo.kill("supervisor", signal.SIGSTOP)
            demo.wait_for_line("runtime", "the supervisor was lost")
            demo.kill("supervisor", signal.SIGCONT)
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["trace_hash"], undisturbed["trace_hash"])


if __name__ == "__main__":
    unittest.main()
