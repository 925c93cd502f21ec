"""The main job with all its real processes, as fast as the machine allows."""

import os
import signal
import time
import unittest

from cell_process import TIME_TO_PROVE, Demo

KEYS = """goal_reached plan_steps plan_cost plan_proved_optimal first_plan_ms optimal_plan_ms replans level_a1_percent
level_a2_percent makespan_s sequential_makespan_s scans overruns scan_p50_us scan_p99_us realtime_factor trace_hash
processes""".split()


class MainJob(unittest.TestCase):
    def run_demo(self, *arguments):
        with Demo("--fast", *arguments) as demo:
            return demo.result()

    def test_the_goal_is_reached_with_the_proved_plan(self):
        report, code = self.run_demo("--seed", 3, *TIME_TO_PROVE)
        self.assertEqual(code, 0, report["stdout"])
        for key in KEYS:
            self.assertIn(key, report)
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["plan_steps"], 17)
        self.assertEqual(report["plan_cost"], 108)
        self.assertTrue(report["plan_proved_optimal"])
        self.assertEqual(report["replans"], 0)
        self.assertEqual(report["processes"], ["runtime", "link", "supervisor"])
        self.assertAlmostEqual(report["level_a1_percent"], 50, delta=2)
        self.assertAlmostEqual(report["level_a2_percent"], 50, delta=2)
        self.assertLess(report["makespan_s"], report["sequential_makespan_s"])

    def test_the_trace_does_not_depend_on_the_speed_of_the_processes(self):
        undisturbed, _ = self.run_demo("--no-compare")
        with Demo("--fast", "--no-compare") as demo:
            # The supervisor stumbles: stopped and continued while the simulated clock waits for its decisions.
            while demo.process.poll() is None:
                pid = demo.pid_of("supervisor")
                if pid is None:
                    continue
                try:
                    os.kill(pid, signal.SIGSTOP)
                    time.sleep(0.02)
                    os.kill(pid, signal.SIGCONT)
                except ProcessLookupError:
                    break
                time.sleep(0.03)
            slowed, code = demo.result()
        self.assertEqual(code, 0, slowed["stdout"])
        self.assertEqual(slowed["trace_hash"], undisturbed["trace_hash"])
        self.assertEqual(slowed["scans"], undisturbed["scans"])

    def test_both_engines_leave_the_same_trace(self):
        traces = [self.run_demo("--no-compare", "--set", f"runtime.engine={engine}")[0]["trace_hash"]
                  for engine in ("native", "vm")]
        self.assertEqual(traces[0], traces[1])

    def test_demos_in_one_domain_do_not_hear_each_other(self):
        alone, _ = self.run_demo("--no-compare")
        one_domain = ("--fast", "--no-compare", "--set", "dds.domain_id=9")
        with Demo(*one_domain) as first, Demo(*one_domain) as second:
            for demo in (first, second):
                report, code = demo.result()
                self.assertEqual(code, 0, report["stdout"])
                self.assertEqual(report["trace_hash"], alone["trace_hash"])

    def test_another_seed_gives_another_trace(self):
        first, _ = self.run_demo("--seed", 1, "--no-compare")
        second, _ = self.run_demo("--seed", 2, "--no-compare")
        self.assertNotEqual(first["trace_hash"], second["trace_hash"])

    def test_a_leak_ends_at_the_goal_or_in_the_safe_state(self):
        report, code = self.run_demo("--no-compare", "--fault", "leak_a1=0.3@40")
        self.assertIn(code, (0, 5), report["stdout"])
        self.assertGreaterEqual(report["replans"], 1)
        self.assertEqual(report["goal_reached"], code == 0)
        self.assertTrue(report["message"])

    def test_a_changed_demand_is_met(self):
        report, code = self.run_demo("--no-compare", "--fault", "(demand c1)=8@20")
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["replans"], 1)
        self.assertTrue(report["goal_reached"])


if __name__ == "__main__":
    unittest.main()
