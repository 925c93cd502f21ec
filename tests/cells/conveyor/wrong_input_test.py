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

    def test_orders_that_wait_for_each_other_have_no_plan(self):
        self.change("problem.pddl", "(turn b3 nobody)", "(turn b3 b1)")
        code, text = self.check()
        self.assertEqual(code, 3, text)


if __name__ == "__main__":
    unittest.main()
