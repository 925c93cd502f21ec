"""The sorting line with all its real processes, as fast as the machine allows. The judge is the plant: where its own
boxes ended."""

import unittest

from cell_process import TIME_TO_PROVE, Demo

# The bench's report without the figures of its tanks.
KEYS = """goal_reached plan_steps plan_cost plan_proved_optimal first_plan_ms optimal_plan_ms replans makespan_s
sequential_makespan_s scans overruns scan_p50_us scan_p99_us realtime_factor trace_hash processes plant""".split()

# problem.pddl: box -> chute and place in it.
ORDERED = {1: (1, 2), 2: (2, 2), 3: (1, 1), 4: (2, 1), 5: (3, 1)}


def sorted_boxes(plant):
    return {box: (plant[f"box_{box}_chute"], plant[f"box_{box}_rank"]) for box in ORDERED}


class SortingJob(unittest.TestCase):
    def run_demo(self, *arguments):
        with Demo("--fast", *arguments, cell="conveyor") as demo:
            return demo.result()

    def faults(self, *texts):
        return [word for text in texts for word in ("--fault", text)]

    def test_every_box_is_where_it_was_ordered(self):
        report, code = self.run_demo("--seed", 3, *TIME_TO_PROVE)
        self.assertEqual(code, 0, report["stdout"])
        for key in KEYS:
            self.assertIn(key, report)
        self.assertTrue(report["goal_reached"])
        self.assertTrue(report["plan_proved_optimal"])
        self.assertEqual(report["plan_cost"], 40)
        self.assertEqual(report["plan_steps"], 36)
        self.assertEqual(report["replans"], 0)
        self.assertEqual(report["processes"], ["runtime", "link", "supervisor"])
        self.assertEqual(sorted_boxes(report["plant"]), ORDERED)
        self.assertEqual(report["plant"]["collisions"], 0)
        self.assertLess(report["makespan_s"], report["sequential_makespan_s"])

    def test_seeds_make_other_traces_and_the_same_order(self):
        traces = set()
        for seed in (1, 2, 9):
            report, code = self.run_demo("--no-compare", "--seed", seed)
            self.assertEqual(code, 0, report["stdout"])
            self.assertEqual(sorted_boxes(report["plant"]), ORDERED)
            traces.add(report["trace_hash"])
        self.assertEqual(len(traces), 3)

    def test_both_engines_leave_the_same_trace(self):
        traces = {self.run_demo("--no-compare", "--set", f"runtime.engine={engine}")[0]["trace_hash"]
                  for engine in ("native", "vm")}
        self.assertEqual(len(traces), 1)

    def test_a_jam_that_is_cleared_is_waited_for(self):
        report, code = self.run_demo("--no-compare", *self.faults(
            "jam_d1=1@3", "jam_d1=0@25", "press_reset=1@26", "press_reset=0@27"))
        self.assertEqual(code, 0, report["stdout"])
        self.assertGreaterEqual(report["replans"], 1)
        self.assertIn("contactor closed", report["record"]["replans"][0]["cause"])
        self.assertEqual(sorted_boxes(report["plant"]), ORDERED)

    def test_a_jam_that_stays_ends_in_the_safe_state(self):
        report, code = self.run_demo("--no-compare", *self.faults("jam_d1=1@3"))
        self.assertEqual(code, 5, report["stdout"])
        self.assertFalse(report["goal_reached"])
        self.assertIn("(await_reset) did not end", report["message"])
        self.assertEqual([report["plant"][f"speed_{belt}"] for belt in ("in", "r", "d1", "d2", "e", "t")], [0] * 6)

    def test_boxes_that_come_in_another_order_are_sorted_by_what_the_reader_says(self):
        report, code = self.run_demo("--no-compare", *self.faults("exchange_boxes=2@0"))
        self.assertEqual(code, 0, report["stdout"])
        self.assertIn("number of the box at the reader is 3.0, expected 2.0",
                      report["record"]["replans"][0]["cause"])
        self.assertEqual(sorted_boxes(report["plant"]), ORDERED)

    def test_a_diverter_that_is_stuck_for_good_is_named_by_the_safe_stop(self):
        report, code = self.run_demo("--no-compare", *self.faults("stuck_push_1=1@10"))
        self.assertEqual(code, 5, report["stdout"])
        self.assertIn("there is no plan from the observed state without diverter 1", report["message"])
        self.assertEqual(report["record"]["incidents"][-1]["devices"], ["diverter 1"])


if __name__ == "__main__":
    unittest.main()
