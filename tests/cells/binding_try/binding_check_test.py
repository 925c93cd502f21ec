"""What `stepwright check` says of a binding before anything runs: one mistake each, at its place."""

import unittest

from planned_cell import CELLS, PlannedCell
from processes import stepwright

VALVE = """
[components.shut_off]
type = "on_off_valve"
kv = "5 m3/h"
travel = "30 s"
in = "water"
out = "product"
command = "SHUT"
"""


class BindingCheck(unittest.TestCase):
    def cell(self, name):
        cell = PlannedCell(CELLS / name)
        self.addCleanup(cell.__exit__)
        return cell

    def says(self, cell, code, *words, ends=1):
        checked = cell.check()
        self.assertEqual(checked.returncode, ends, checked.stderr)
        self.assertRegex(checked.stderr, rf"binding\.toml(:\d+:\d+)?: (warning: )?{code}")
        for word in words:
            self.assertIn(word, checked.stderr)

    def test_an_action_without_outputs(self):
        cell = self.cell("batch_mixer")
        cell.change("binding.toml", 'outputs = ["STIR"]\n', "")
        self.says(cell, "B0010", "(mix ?m)", "outputs = []", ends=0)
        cell.change("binding.toml", 'action = "(mix ?m)"', 'action = "(mix ?m)"\noutputs = []')
        self.assertNotIn("B0010", cell.check().stderr)

    def test_terminals_that_the_plant_does_not_have(self):
        cell = self.cell("batch_mixer")
        cell.change("binding.toml", '"%QX0.3"', '"%QX0.7"')
        self.says(cell, "B0011", "'HEAT' is at %QX0.7", "STIR %QX0.4")

    def test_what_no_sensor_shows(self):
        cell = self.cell("pick_place")
        cell.change("binding.toml", 'believed = ["(at ?i ?p)", "(carried ?i)", "(arrived)", "(sent)"]', 'believed = ["(at ?i ?p)", "(arrived)", "(sent)"]')
        self.says(cell, "B0012", "(carried", "believed", ends=0)

    def test_units_and_calibrations_that_do_not_match(self):
        for old, new, word in (('unit = "degC"', 'unit = "bar"', "bar"), ("[[0, 0], [100, 27648]]\nmust_move = true\ntolerance = 6.0",
                                                                     "[[0, 0], [150, 27648]]\nmust_move = true\ntolerance = 6.0", "[100, 27648]")):
            cell = self.cell("batch_mixer")
            cell.change("binding.toml", old, new)
            self.says(cell, "B0013", word)

    def test_units_and_scales_that_the_tank_does_not_have(self):
        lines = 'unit = "percent"\nrange = [0, 100]\ncalibration = [[0, 0], [100, 27648]]\n'
        for unit, full, said in (("m3", 100, "calibration = [[0, 0], [5, 27648]]"), ("l", 100, "calibration = [[0, 0], [5000, 27648]]"),
                                 ("m", 100, "calibration = [[0, 0], [5, 27648]]"), ("t", 100, "calibration = [[0, 0], [5, 27648]]"),
                                 ("bar", 100, "a share of the tank 'north'"), ("m3", 5, ""), ("l", 5000, ""), ("m", 5, "")):
            cell = self.cell("pump_station")
            text = (cell.folder / "binding.toml").read_text(encoding="utf-8")
            before, after = text.split("[sensors.north]")
            self.assertIn(lines, after)
            (cell.folder / "binding.toml").write_text(before + "[sensors.north]" + after.replace(
                lines, f'unit = "{unit}"\nrange = [0, {full}]\ncalibration = [[0, 0], [{full}, 27648]]\n', 1), encoding="utf-8")
            if said:
                self.says(cell, "B0013", said)
            else:
                self.assertNotIn("B0013", cell.check().stderr)

    def test_two_sensors_that_read_one_tag(self):
        cell = self.cell("pump_station")
        cell.change("binding.toml", 'tag = "L_SOUTH"', 'tag = "L_NORTH"')
        self.says(cell, "B0016", "'north' and 'south' read the same tag 'L_NORTH'")

    def test_a_plant_that_cannot_be_read_is_one_error(self):
        cell = self.cell("pump_station")
        cell.change("plant.toml", 'volume = "20 m3"', 'volume = "20 s"')
        checked = cell.check()
        self.assertEqual(checked.returncode, 1)
        self.assertIn("C0341", checked.stderr)
        self.assertNotIn("C0531", checked.stderr)

    def test_addresses_that_overlap(self):
        cell = self.cell("pump_station")
        cell.change("plant.toml", '"%IW2"', '"%IW1"')
        self.assertIn("C0304", cell.check().stderr)
        said = stepwright("plant", cell.folder / "plant.toml")
        self.assertEqual(said.returncode, 1)
        self.assertRegex(said.stderr, r"plant\.toml:\d+:\d+: C0304: %IW1 overlaps %IW1, to which 'L_NORTH' is wired")

    def test_completions_that_can_never_be(self):
        cell = self.cell("batch_mixer")
        cell.change("problem.pddl", "(= (hot) 60)", "(= (hot) 160)")
        self.says(cell, "B0014", "160", "0 to 100")
        cell = self.cell("pick_place")
        cell.change("binding.toml", 'until = { fact = "(holding)" }', 'until = { fact = "(full ?p)" }')
        cell.change("domain.pddl", "(and (over ?p) (at ?i ?p) (full ?p) (free))", "(and (over ?p) (at ?i ?p) (free))")
        self.says(cell, "B0014", "which it does not bring about")
        cell = self.cell("pick_place")
        cell.change("binding.toml", 'hold = ["(over ?p)"]', 'hold = ["(free)"]')
        self.says(cell, "B0014", "which it undoes itself")

    def test_timeouts_that_are_too_short(self):
        cell = self.cell("batch_mixer")
        cell.change("binding.toml", "timeout_s = 90", "timeout_s = 20")
        self.says(cell, "B0015", "timeout_s = ")
        cell = self.cell("batch_mixer")
        with open(cell.folder / "plant.toml", "a", encoding="utf-8") as file:
            file.write(VALVE)
        cell.change("plant.toml", "[terminals]\n", '[terminals]\nSHUT = "%QX0.6"\n')
        cell.change("plant.toml", 'from = "blend.ready"', 'from = "shut_off.opened"')
        cell.change("binding.toml", "timeout_s = 150\nduration = { fixed_s = 45 }", "timeout_s = 20\nduration = { fixed_s = 5 }")
        self.says(cell, "B0015", "'shut_off' takes 30 s")

    def test_believed_names_what_the_domain_has(self):
        cell = self.cell("pick_place")
        cell.change("binding.toml", '"(carried ?i)"', '"(caried ?i)"')
        self.says(cell, "B0007", "carried")


if __name__ == "__main__":
    unittest.main()
