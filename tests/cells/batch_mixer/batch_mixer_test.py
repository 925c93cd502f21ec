"""The batch mixer: written by doc/plan-your-plant.md, run to its recipe, and disturbed."""

import unittest

from planned_cell import CellOfThisTree


class BatchMixer(CellOfThisTree, unittest.TestCase):
    NAME = "batch_mixer"
    FAULTS = ("water_pump.weak=0.5@10", "syrup_pump.weak=0@40", "heater.weak=0@150", "heater.weak=0.6@150", "blend.works=0@2",
              "mixer.leak=0.5@60", "mixer_card.frozen=1@30", "temperature_card.broken_wire=1@200", "product_pump.weak=0@5")

    def test_a_heater_that_fails_is_named(self):
        done, report = self.cell.demo("--fault", "heater.weak=0@5")
        self.assertEqual(done.returncode, 5)
        self.assertIn("heater", report["message"])

    def test_another_recipe_is_another_plan(self):
        self.cell.change("problem.pddl", "(= (dosed water) 40) (= (dosed syrup) 20) (= (product) 60)", "(= (dosed water) 20) (= (dosed syrup) 20)")
        done, report = self.cell.demo()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(report["plan_steps"], 2)

    def test_a_second_batch_goes_onto_what_is_left_of_the_first(self):
        self.cell.change("problem.pddl", "(= (dosed water) 40) (= (dosed syrup) 20) (= (product) 60)", "(= (dosed water) 80) (= (dosed syrup) 40) (= (product) 120)")
        done, report = self.cell.demo()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(report["goal_reached"])


if __name__ == "__main__":
    unittest.main()
