"""What is wrong in the files of the sorting line, said with its place."""

import pathlib
import shutil
import tempfile
import unittest

from cell_process import stepwright

CELL = pathlib.Path(__file__).parent


class WrongInput(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(self.folder.cleanup)
        self.cell = pathlib.Path(self.folder.name)
        for file in CELL.glob("*"):
            if file.suffix in (".toml", ".pddl", ".xml"):
                shutil.copy(file, self.cell)

    def change(self, name, old, new):
        file = self.cell / name
        text = file.read_text(encoding="utf-8")
        self.assertIn(old, text)
        file.write_text(text.replace(old, new, 1), encoding="utf-8")

    def check(self):
        result = stepwright("check", "--config", self.cell / "cell.toml")
        return result.returncode, result.stdout + result.stderr

    def test_the_cell_is_good(self):
        code, text = self.check()
        self.assertEqual(code, 0, text)

    def test_a_missing_program(self):
        self.change("cell.toml", "safety.xml", "safty.xml")
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"cell\.toml:\d+:\d+.*C0006.*safty\.xml")

    def test_a_program_that_names_no_variable_of_the_cell(self):
        self.change("safety.xml", '<variable name="eye_in">', '<variable name="eye_im">')
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"safety\.xml:\d+:\d+.*E0207.*eye_im")

    def test_a_fault_that_the_line_does_not_have(self):
        self.change("cell.toml", "[dds]", '[[faults]]\nat_s = 1\nname = "leak_a1"\nvalue = 1\n\n[dds]')
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"cell\.toml:\d+:\d+.*C0311.*sorting line")

    def test_a_terminal_that_the_line_does_not_have(self):
        self.change("cell.toml", 'push_t = "%QX1.3"', 'push_x = "%QX1.3"')
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"cell\.toml:\d+:\d+.*C0301.*push_x")

    def test_a_plant_that_there_is_not(self):
        self.change("cell.toml", '"sorting_line"', '"sorting_lime"')
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"cell\.toml:\d+:\d+.*C0006.*sorting_lime")
        self.assertIn("did you mean 'sorting_line'?", text)
        self.assertNotIn("C0301", text)  # its ports are not held against another plant

    def test_more_diverters_than_there_can_be(self):
        self.change("cell.toml", 'kind = "sorting_line"', 'kind = "sorting_line"\ndiverters = 9')
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"cell\.toml:\d+:\d+.*C0004.*plant\.diverters")

    def test_two_eyes_at_one_terminal(self):
        self.change("cell.toml", 'eye_r = "%IX0.1"', 'eye_r = "%IX0.0"')
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"cell\.toml:\d+:\d+.*C0304.*eye_in")

    def test_an_eye_and_a_belt_that_nobody_wired(self):
        self.change("cell.toml", 'eye_r = "%IX0.1"\n', "")
        self.change("cell.toml", 'belt_t = "%QX0.5"\n', "")
        code, text = self.check()
        self.assertEqual(code, 0, text)  # a part of a plant may be left out on purpose
        self.assertRegex(text, r"cell\.toml:\d+:\d+: warning: C0531.*%IX0\.1.*eye_r")
        self.assertRegex(text, r"cell\.toml:\d+:\d+: warning: C0531.*%QX0\.5.*belt_t")
        self.assertEqual(text.count("C0531"), 2, text)

    def test_a_program_that_is_cut_off(self):
        file = self.cell / "safety.xml"
        file.write_text(file.read_text(encoding="utf-8")[:4000], encoding="utf-8")
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"safety\.xml:\d+:\d+.*E0801.*well-formed")

    def test_a_tag_that_the_binding_does_not_declare(self):
        self.change("binding.toml", "eye_r = {", "eye_q = {")
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"binding\.toml:\d+:\d+.*B0007.*eye_r")

    def test_a_box_that_there_is_not(self):
        self.change("problem.pddl", "(turn b3 nobody)", "(turn b3 b9)")
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertRegex(text, r"problem\.pddl:\d+:\d+.*P0104.*b9")

    def test_orders_that_wait_for_each_other_have_no_plan(self):
        self.change("problem.pddl", "(turn b3 nobody)", "(turn b3 b1)")
        code, text = self.check()
        self.assertEqual(code, 3, text)


if __name__ == "__main__":
    unittest.main()
