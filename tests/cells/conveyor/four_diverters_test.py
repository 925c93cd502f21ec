"""The line with four diverters and orders that need each of them (tests/cells/four_diverters)."""

import unittest

from cell_process import TIME_TO_PROVE, Demo

# problem.pddl: box -> chute and place in it.
ORDERED = {1: (4, 1), 2: (2, 2), 3: (1, 1), 4: (3, 1), 5: (5, 1), 6: (2, 1)}


def sorted_boxes(plant):
    return {box: (plant[f"box_{box}_chute"], plant[f"box_{box}_rank"]) for box in ORDERED}


class FourDiverters(unittest.TestCase):
    def run_demo(self, *arguments):
        with Demo("--fast", "--no-compare", *arguments, cell="four_diverters") as demo:
            return demo.result()

    def test_every_diverter_is_driven_by_the_plan(self):
        report, code = self.run_demo("--seed", 3, *TIME_TO_PROVE)
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["plan_proved_optimal"])
        self.assertEqual(report["plan_cost"], 47)
        self.assertEqual(report["replans"], 0)
        self.assertEqual(sorted_boxes(report["plant"]), ORDERED)
        self.assertEqual(report["plant"]["collisions"], 0)
        done = [action["text"] for action in report["record"]["episodes"][0]["actions"]]
        for diverter in ("d1 c1", "d2 c2", "d3 c3", "d4 c4"):
            self.assertTrue(any(text.startswith("(divert") and diverter in text for text in done), diverter)

    def test_a_diverter_that_is_stuck_for_good_is_named_by_the_safe_stop(self):
        report, code = self.run_demo("--fault", "stuck_push_4=1@10")
        self.assertEqual(code, 5, report["stdout"])
        self.assertIn("there is no plan from the observed state without diverter 4", report["message"])

    def test_a_diverter_that_is_stuck_for_a_while_is_tried_again(self):
        undisturbed, _ = self.run_demo()
        for diverter in (3, 4):
            start = next(action["started_s"] for action in undisturbed["record"]["episodes"][0]["actions"]
                         if action["text"].startswith("(divert") and f"d{diverter} c{diverter}" in action["text"])
            fault = f"stuck_push_{diverter}"
            # It is given 8 s; the second try begins some seconds after that.
            report, code = self.run_demo("--fault", f"{fault}=1@{start - 1}", "--fault", f"{fault}=0@{start + 10}")
            self.assertEqual(code, 0, report["stdout"])
            self.assertGreaterEqual(report["replans"], 1)
            self.assertEqual(sorted_boxes(report["plant"]), ORDERED)


if __name__ == "__main__":
    unittest.main()
