"""`stepwright binding try`: domains and bindings that are wrong in one way each, and what it says of them."""

import json
import tempfile
import pathlib
import unittest

from planned_cell import CELLS, PlannedCell
from processes import stepwright


class BindingTry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        made = stepwright("new", "batch", "--plan", cwd=cls.made.name)
        assert made.returncode == 0, made.stderr

    @classmethod
    def tearDownClass(cls):
        cls.made.cleanup()

    def batch(self):
        cell = PlannedCell(pathlib.Path(self.made.name) / "batch")
        self.addCleanup(cell.__exit__)
        return cell

    def line(self):
        cell = PlannedCell(CELLS / "pick_place")
        self.addCleanup(cell.__exit__)
        return cell

    def finds(self, cell, code, *words, of=()):
        """The code stands in the report, with words of its message or hint; the command ends with 1."""
        done, tried = cell.attempt("--seeds", "2", *of)
        self.assertIsNotNone(tried, done.stderr)
        found = [each for each in tried["diagnostics"] if each["code"] == code]
        self.assertTrue(found, tried["diagnostics"])
        said = " ".join(each["message"] + " " + each["hint"] for each in found)
        for word in words:
            self.assertIn(word, said)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertFalse(tried["sound"])
        self.assertRegex(done.stderr, rf"binding\.toml:\d+:\d+: {code}: ")
        return found[0]

    def test_what_is_right_passes_without_a_word(self):
        done, tried = self.batch().attempt()
        self.assertEqual((done.returncode, done.stderr, tried["diagnostics"]), (0, "", []))
        self.assertTrue(tried["sound"])
        for each in tried["actions"]:
            self.assertEqual(each["done"], each["runs"], each)
            self.assertGreaterEqual(each["runs"], 3)
            self.assertGreater(each["mean_s"], 0)
            self.assertLess(each["spread_s"], each["mean_s"])
            self.assertLess(abs(each["duration_s"] - each["mean_s"]), max(0.5, 0.3 * each["mean_s"]), each)  # as B0030
        self.assertRegex(done.stdout, r"(?m)^\(heat v1\) +\d+ +\d+ +\d+\.\d\d")
        self.assertIn("0 problems", done.stdout)

    def test_a_level_that_goes_the_other_way(self):
        cell = self.batch()
        cell.change("domain.pddl", "(increase (level ?v) (litres ?a))", "(decrease (level ?v) (litres ?a))")
        self.finds(cell, "B0025", "lowers level of the vessel", "the plant raises it", "(increase (level v1)", of=("--action", "(fill ?v ?a)"))

    def test_one_that_is_too_slow(self):
        cell = self.batch()
        cell.change("plant.toml", 'power = "40 kW"', 'power = "6 kW"')
        found = self.finds(cell, "B0026", "timeout_s = ", of=("--action", "(heat ?v)"))
        self.assertIn("after 400 s", found["message"])

    def test_one_without_effect(self):
        cell = self.batch()
        cell.change("binding.toml", 'outputs = ["HEAT"]', 'outputs = ["FEED"]')
        self.finds(cell, "B0024", "temperature of the vessel", "what changes is level of the vessel", of=("--action", "(heat ?v)"))

    def test_a_fact_that_no_sensor_shows(self):
        cell = self.line()
        cell.change("binding.toml", 'fact = "(full b1)"\ntag = "E_B1"', 'fact = "(full b1)"\ntag = "E_B2"')
        self.finds(cell, "B0027", "(full b1)", of=("--action", "(place red b1)"))

    def test_a_duration_that_is_far_off(self):
        cell = self.batch()
        cell.change("binding.toml", "per_unit_s = 4.2", "per_unit_s = 0.5")
        found = self.finds(cell, "B0030", "spread", of=("--action", "(heat ?v)"))
        self.assertRegex(found["hint"], r'duration = \{ fixed_s = [\d.]+, per_unit_s = [3-5][\d.]*, of = "\(level \?v\)" \}')

    def test_a_level_that_ends_elsewhere(self):
        cell = self.batch()
        cell.change("plant.toml", 'lift = "1.5 m"', 'lift = "1.5 m"\nspin_up = "8 s"')
        self.finds(cell, "B0028", "level of the vessel", "pre_act = ", of=("--action", "(fill ?v ?a)"))

    def test_a_change_of_which_the_domain_is_silent(self):
        cell = self.batch()
        cell.change("domain.pddl", "(increase (product) (- (level ?v) (heel ?v)))", "")
        self.finds(cell, "B0029", "changes product", "(increase (product)", of=("--action", "(empty ?v)"))

    def test_a_domain_that_claims_what_the_plant_does_not(self):
        cell = self.batch()
        cell.change("domain.pddl", "(assign (temperature ?v) (cold))", "(assign (temperature ?v) (hot))")
        self.finds(cell, "B0024", "temperature of the vessel", of=("--action", "(fill ?v ?a)"))
        self.finds(cell, "B0022", "(temperature v1)", of=("--action", "(empty ?v)"))

    def test_what_another_action_does_wrong_is_not_said_of_a_right_one(self):
        for old, new, action in ((":effect (assign (temperature ?v) (hot))", ":effect (and (assign (temperature ?v) (hot)) (increase (product) 5))", "heat"),
                                 ("(increase (batches) 1)", "(increase (batches) 1) (decrease (product) 3)", "fill")):
            cell = self.batch()
            cell.change("domain.pddl", old, new)
            done, tried = cell.attempt("--seeds", "1")
            self.assertEqual(done.returncode, 1, done.stderr)
            for each in tried["diagnostics"]:
                self.assertEqual((each["code"], each["message"].startswith(f"({action} ")), ("B0024", True), tried["diagnostics"])

    def test_a_fact_that_is_to_be_held_and_goes(self):
        cell = self.line()
        cell.change("binding.toml", 'hold = ["(over ?p)"]', 'hold = ["(free)"]')
        self.finds(cell, "B0023", "(free)", of=("--action", "(pick red in)"))

    def test_a_plant_that_begins_elsewhere(self):
        cell = self.batch()
        cell.change("problem.pddl", "(= (level v1) 2)", "(= (level v1) 12)")
        self.finds(cell, "B0020", "level of the vessel", of=("--action", "(fill ?v ?a)"))

    def test_what_stands_behind_a_wrong_action_is_not_tried(self):
        cell = self.batch()
        cell.change("plant.toml", 'power = "40 kW"', 'power = "1 W"')
        done, tried = cell.attempt("--seeds", "1", "--action", "(empty ?v)")
        self.assertEqual([each["code"] for each in tried["diagnostics"]], ["B0021"])
        self.assertEqual(done.returncode, 0, "what is wrong is another action")

    def test_wrong_input(self):
        cell = self.batch()
        for arguments, code, said in ((("--action", "(hea ?v)"), 1, "M0031"), (("--action", "(("), 1, "M0031"), (("--seeds", "0"), 2, "seeds")):
            done = stepwright("binding", "try", cell.file, *arguments)
            self.assertEqual(done.returncode, code, arguments)
            self.assertIn(said, done.stderr)
        for arguments, code, said in ((("try", "no_such_cell"), 1, "M0002"), (("try", cell.folder / "none.toml"), 1, "none.toml"), (("tri",), 2, ""), ((), 2, "")):
            done = stepwright("binding", *arguments)
            self.assertEqual(done.returncode, code, arguments)
            self.assertIn(said, done.stderr)
        self.assertIn("M0032", stepwright("binding", "try", "fleet").stderr)
        plantless = self.batch()
        plantless.change("cell.toml", 'kind = "model"               # of components\nfile = "plant.toml"', 'kind = "none"')
        self.assertIn("C0448", stepwright("binding", "try", plantless.file).stderr)
        cell.change("plant.toml", 'volume = "50 l"', 'volume = "50 s"')
        self.assertIn("C0341", stepwright("binding", "try", cell.file).stderr)
        cell.change("binding.toml", "[tags]", "[tags", 1)
        self.assertIn("B0001", stepwright("binding", "try", cell.file).stderr)

    def test_the_report_may_go_to_the_standard_output(self):
        done = stepwright("binding", "try", self.batch().file, "--seeds", "1", "--action", "(fill ?v ?a)", "--json", "-")
        self.assertEqual(len(json.loads(done.stdout)["actions"]), 2)


if __name__ == "__main__":
    unittest.main()
