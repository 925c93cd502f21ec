"""The pick-and-place line: written by doc/plan-your-plant.md, run to its order, and disturbed."""

import unittest

from planned_cell import CellOfThisTree


class PickPlace(CellOfThisTree, unittest.TestCase):
    NAME = "pick_place"
    FAULTS = ("gripper.works=0@20", "gripper.lost=50@15", "lift.stuck=1@10", "eye_b1.blind=1@5", "eye_out.stuck=1@5", "at_b2.stuck=0@5",
              "lift.slow=3@2")

    def test_the_order_is_changed_over_a_buffer(self):
        done, report = self.cell.demo()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreaterEqual(report["plan_steps"], 20)

    def test_the_same_order_needs_no_buffer(self):
        before = self.cell.demo()[1]["plan_steps"]
        self.cell.change("problem.pddl", "(= (rank green) 1) (= (rank red) 2)", "(= (rank green) 2) (= (rank red) 1)")
        done, report = self.cell.demo()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertLess(report["plan_steps"], before)

    def test_a_gripper_that_fails_is_named(self):
        done, report = self.cell.demo("--fault", "gripper.works=0@5")
        self.assertEqual(done.returncode, 5)
        self.assertIn("gripper", report["message"])


if __name__ == "__main__":
    unittest.main()
