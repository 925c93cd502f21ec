"""Processes are killed in the middle of a run; the demo starts them again as an init system would."""

import time
import unittest

from cell_process import Demo

PACED = ("--no-compare", "--set", "clock.speed=25")


class Kill(unittest.TestCase):
    def test_the_supervisor_is_killed_and_a_new_one_finishes_the_running_plan(self):
        with Demo(*PACED) as demo:
            demo.wait_for_actions(5)
            demo.kill("supervisor")
            demo.wait_for_line("supervisor", "following the plan again")
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 0)
        self.assertEqual(report["restarts"], {"supervisor": 1})

    def test_the_supervisor_is_killed_under_the_policy_safe_and_a_new_one_replans(self):
        with Demo(*PACED, "--set", "safe_state.on_lost_supervisor=safe", "--set",
                  "safe_state.supervisor_lost_after_ms=300") as demo:
            demo.wait_for_actions(5)
            demo.kill("supervisor")
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])

    def test_the_link_is_killed_and_the_run_ends_as_if_nothing_had_happened(self):
        with Demo("--fast", "--no-compare") as demo:
            undisturbed, _ = demo.result()
        with Demo(*PACED) as demo:
            for actions in (2, 6, 11):
                demo.wait_for_actions(actions)
                demo.kill("link")
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["trace_hash"], undisturbed["trace_hash"])
        self.assertEqual(report["scans"], undisturbed["scans"])
        self.assertEqual(report["replans"], 0)

    def test_the_runtime_is_killed_and_the_supervisor_reports_it_and_goes_on(self):
        with Demo(*PACED) as demo:
            delays = []
            # A machine that is busy elsewhere may hold up one report, but not each of three.
            while len(delays) < 3 and (not delays or min(delays) >= 1.0):
                demo.wait_for_actions(5 + 2 * len(delays))
                written = demo.log_bytes("supervisor")
                killed_at = time.time()
                demo.kill("runtime")
                # The demo starts it again at once, so the supervisor may meet the new one before it misses the old one.
                reported_at = demo.time_of_line("supervisor", r"the runtime (does not answer|was restarted)", written)
                delays.append(reported_at - killed_at)
            report, code = demo.result()
        self.assertLess(min(delays), 1.0, delays)
        # The plant outlives the process that simulates it: the liquid is where it was, so the actions done stay done.
        first, second = report["record"]["episodes"][0], report["record"]["episodes"][1]
        self.assertLess(len(second["actions"]), len(first["actions"]))
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.assertGreaterEqual(report["replans"], 1)


if __name__ == "__main__":
    unittest.main()
