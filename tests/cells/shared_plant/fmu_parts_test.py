"""FMUs as components of a plant, with the real processes: two of them, a pump and a tank in lock-step with the scan."""

import os
import signal
import unittest

from fmu_pack import pack
from processes import stepwright
from stepped_cell import SteppedCell, gone

NAMES = ("Main.level", "Main.full", "Main.valve", "Main.filled")
FAR = 15_000

# What the first gives out at its second place goes into the second at its first, of which a half counts.
MIXERS = """\
[components.first]
type = "fmu"
file = "mixer3.fmu"
timeout = "60 s"
start_timeout = "120 s"

[components.second]
type = "fmu"
file = "mixer3.fmu"
timeout = "60 s"
start_timeout = "120 s"
parameters = { "share[1,1]" = "0.25", "share[1,2]" = "1" }
"inflow[1]" = "first.outflow[2]"
"open[2]" = "SHUT"

[components.card]
type = "analog_input"
of = "second.outflow[1]"
low = "0 l/s"
high = "10 l/s"

[terminals]
SHUT = "%QX0.0"
SHOWN = { address = "%IW0", from = "card" }
"""


class PartsCell(SteppedCell):
    """`changes` are to the plant's file."""

    def __init__(self, *changes, faults=()):
        rows = "".join(f'\n[[faults]]\nat_s = {at_s}\nname = "{name}"\nvalue = {value}\n' for at_s, name, value in faults)
        super().__init__("parts.toml", ("\n[runtime]", f"{rows}\n[runtime]"), limits=False)
        for name in ("tank2", "tank3"):
            pack(name, self.folder / f"{name}.fmu")
        self.plant_file = self.folder / "parts_plant.toml"
        text = self.plant_file.read_text(encoding="utf-8")
        for old, new in (('type = "fmu"', 'type = "fmu"\ntimeout = "60 s"\nstart_timeout = "120 s"'), *changes):
            assert old in text, old
            text = text.replace(old, new)
        self.plant_file.write_text(text, encoding="utf-8")


class FmuParts(unittest.TestCase):
    def test_fmus_and_components_are_one_plant_and_do_the_same_again(self):
        results = []
        for _ in range(2):
            with PartsCell() as cell:
                self.assertEqual(cell.check(), (0, []))
                cell.run()
                self.assertEqual(len(cell.plant_processes(2)), 2)
                results.append(cell.step_to(FAR) + " ".join(cell.values(*NAMES)))
        self.assertEqual(results[0], results[1])
        level, _, _, filled = results[0].split()[-4:]
        self.assertAlmostEqual(int(level), 20736, delta=100)  # where the program keeps it
        self.assertEqual(filled, "TRUE")

    def test_one_fmu_that_is_lost_costs_the_plant_and_not_the_runtime(self):
        for trap, said in ((1, "'upper': the plant is lost at 100.*its process was killed by signal 6"),
                           (3, "'upper': the plant is lost at 100.*the solver gave up")):
            with self.subTest(trap=trap), PartsCell(faults=((100.0, "upper.trap", trap),)) as cell:
                cell.run()
                plants = cell.plant_processes(2)
                cell.ask("step", str(10_010 - cell.scan), "--config", cell.config)
                cell.runtime.wait_for(said)
                self.assertTrue(cell.runtime.running())
                self.assertTrue(any(gone(each) for each in plants))
                self.assertEqual(cell.values("%QX0.0"), ["FALSE"])

    def test_the_process_of_one_is_killed_while_nobody_steps_it(self):
        with PartsCell() as cell:
            cell.run()
            os.kill(cell.plant_processes(2)[1], signal.SIGKILL)
            cell.runtime.wait_for("'lower': the plant is lost .* killed by signal 9")
            self.assertTrue(cell.runtime.running())

    def test_what_is_wrong_has_its_line(self):
        for wrong, code, says in (('valve = "upper.fulll"', "C0343", "upper"), ('drian = "DRAIN"', "C0335", "no variable")):
            right = wrong.replace("fulll", "full").replace("drian", "drain")
            with self.subTest(wrong=wrong), PartsCell((right, wrong)) as cell:
                exit_code, found = cell.check()
                found = [each for each in found if each["severity"] == "error"]
                self.assertEqual((exit_code, [each["code"] for each in found]), (1, [code]))
                self.assertIn(says, found[0]["message"])
                self.assertEqual(self.line_of(cell, found[0]), wrong)
                self.assertIn(code, cell.refused())

    @staticmethod
    def line_of(cell, problem):
        return cell.plant_file.read_text(encoding="utf-8").splitlines()[problem["line"] - 1]

    def test_arrays_are_joined_by_their_elements(self):
        with SteppedCell("fmu.toml") as cell:
            pack("mixer3", cell.folder / "mixer3.fmu")
            plant, table = cell.folder / "plant.toml", cell.folder / "answer.csv"
            plant.write_text(MIXERS, encoding="utf-8")
            done = stepwright("plant", plant, "--seconds", "1", "--value", "second.outflow[1]", "--value", "second.outflow[2]",
                              "--csv", table)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            last = table.read_text(encoding="utf-8").splitlines()[-1].split(",")
            self.assertEqual([float(each) for each in last[1:]], [0.5 * 1 + 2, 0.0])
            plant.write_text(MIXERS.replace("outflow[2]", "outflow[3]"), encoding="utf-8")
            done = stepwright("plant", plant)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"plant\.toml:13:\d+: .*outflow\[3\]")

    def test_plant_lists_it_and_runs_it_alone(self):
        with PartsCell() as cell:
            done = stepwright("plant", cell.plant_file)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            for words in ("upper.level", "lower.full", "upper.trap"):
                self.assertIn(words, done.stdout)
            table = cell.folder / "answer.csv"
            done = stepwright("plant", cell.plant_file, "--set", "VALVE=1@1", "--value", "upper.level", "--seconds", "2",
                              "--csv", table)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            last = table.read_text(encoding="utf-8").splitlines()[-1].split(",")
            # A second of 0.01 m3/s into 0.5 m2, but for what the pump takes.
            self.assertAlmostEqual(float(last[1]), 0.22, delta=0.01)
            done = stepwright("plant", cell.plant_file, "--fault", "upper.trap=1@1", "--seconds", "2", "--csv", table)
            self.assertEqual(done.returncode, 5)
            self.assertRegex(done.stderr, "C0337.*'upper'")


if __name__ == "__main__":
    unittest.main()
