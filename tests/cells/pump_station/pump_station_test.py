"""The pumping station: written by doc/plan-your-plant.md, run to its levels, and disturbed."""

import unittest

from planned_cell import CellOfThisTree


class PumpStation(CellOfThisTree, unittest.TestCase):
    NAME = "pump_station"
    FAULTS = ("a.weak=0@20", "a.weak=0.7@10", "b.weak=0@100", "c.weak=0@5", "north.leak=0.2@60", "south_card.frozen=1@130",
              "sump_card.broken_wire=1@30")

    def test_the_pump_that_stands_by_takes_over(self):
        done, report = self.cell.demo("--fault", "a.weak=0@20")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(report["goal_reached"])
        self.assertGreater(report["replans"], 0)

    def test_with_the_stand_by_gone_as_well_it_stops_and_says_what_stands_still(self):
        done, report = self.cell.demo("--fault", "a.weak=0@20", "--fault", "c.weak=0@20")
        self.assertEqual(done.returncode, 5, done.stdout + done.stderr)
        self.assertIn("north tower", report["message"])
        self.assertIn("PUMP_C", report["message"])


if __name__ == "__main__":
    unittest.main()
