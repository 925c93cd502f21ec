"""FMUs as plants with the real processes: FMI 2.0 and 3.0, and what is wrong with archives, descriptions, libraries."""

import os
import signal
import unittest
import zipfile

from fmu_pack import HERE, pack
from stepped_cell import SteppedCell, gone

NAMES = ("Main.level", "Main.valve", "Main.drain", "Main.filled")
FAR = 20_000


def fault(name, value, at_s=100.0):
    return ("\n[runtime]", f'\n[[faults]]\nat_s = {at_s}\nname = "{name}"\nvalue = {value}\n\n[runtime]')


class FmuCell(SteppedCell):
    def __init__(self, name, *changes, **packing):
        super().__init__("fmu.toml", ('"tank2.fmu"', f'"{name}.fmu"'), *changes)
        self.fmu = pack(name, self.folder / f"{name}.fmu", **packing)


class FmuPlant(unittest.TestCase):
    def test_both_versions_do_the_same_and_again(self):
        results = []
        for name in ("tank2", "tank3", "tank2"):
            with FmuCell(name) as cell:
                self.assertEqual(cell.check(), (0, []))
                cell.run()
                cell.step_to(FAR)
                results.append(cell.values(*NAMES))
        self.assertEqual(results[0], results[1])
        self.assertEqual(results[0], results[2])
        self.assertAlmostEqual(int(results[0][0]), 20736, delta=30)
        self.assertEqual(results[0][3], "TRUE")

    def test_parameters_and_faults_reach_the_fmu(self):
        for name in ("tank2", "tank3"):
            with self.subTest(name=name), FmuCell(name, ("area = 0.5", "area = 50.0"), fault("leak", 100.0, 190.0)) as cell:
                cell.run()
                cell.step_to(18_000)  # a hundred times as slow
                self.assertLess(int(cell.values("Main.level")[0]), 4000)
                cell.step_to(FAR)
                self.assertEqual(cell.values("Main.level"), ["0"])

    def test_a_crash_a_hang_or_a_refusal_of_the_fmu_costs_the_plant(self):
        for name in ("tank2", "tank3"):
            for trap, said in ((1, "its process was killed by signal 6"), (2, "no answer to a step within 3000 ms"),
                               (3, "the FMU makes no step: the solver gave up"),
                               (4, "the FMU makes no step: it asks for the end of the simulation")):
                with self.subTest(name=name, trap=trap), FmuCell(
                        name, fault("trap", trap), ("[plant]\n", "[plant]\ntimeout_ms = 3_000\n" if trap == 2 else "[plant]\n")) as cell:
                    cell.run()
                    plant = cell.plant_process()
                    cell.ask("step", str(10_010 - cell.scan), "--config", cell.config)
                    cell.runtime.wait_for("the plant is lost at 100.*" + said)
                    self.assertTrue(gone(plant))
                    self.assertTrue(cell.runtime.running())
                    self.assertEqual(cell.values("%QX0.0"), ["FALSE"])

    def test_the_process_of_an_fmu_is_killed(self):
        with FmuCell("tank2") as cell:
            cell.run()
            os.kill(cell.plant_process(), signal.SIGKILL)
            cell.runtime.wait_for("the plant is lost .* killed by signal 9")

    def wrong(self, cell, code, message, hint=""):
        """`check` and the runtime refuse the cell alike."""
        exit_code, found = cell.check()
        self.assertEqual(exit_code, 1)
        self.assertEqual(found[0]["code"], code, found)
        self.assertIn(message, found[0]["message"])
        self.assertIn(hint, found[0]["hint"])
        said = cell.refused()
        self.assertRegex(said, rf"R0155.*{code}")
        return found

    def test_an_fmu_of_another_platform_is_named(self):
        with FmuCell("tank2", folder="win64") as cell:
            self.wrong(cell, "C0333", "no library for this machine", "win64")

    def test_an_archive_that_leads_out_of_its_folder_is_not_unpacked(self):
        with FmuCell("tank2", more=(("../../evil", "x"),)) as cell:
            self.wrong(cell, "C0330", "out of its folder")
            self.assertEqual(list(cell.folder.rglob("evil")), [])

    def test_what_is_no_fmu_is_said(self):
        with FmuCell("tank2") as cell:
            cell.fmu.write_text("no archive", encoding="utf-8")
            self.wrong(cell, "C0330", "no ZIP archive")
            cell.fmu.unlink()
            self.wrong(cell, "C0330", "no such file")
            with zipfile.ZipFile(cell.fmu, "w") as archive:
                archive.writestr("readme", "")
            self.wrong(cell, "C0330", "modelDescription.xml")

    def test_a_wrong_description_has_its_line(self):
        text = (HERE / "tank2.xml").read_text(encoding="utf-8")
        with FmuCell("tank2", description=text.replace("<Boolean/>", "<Boolean>")) as cell:
            found = self.wrong(cell, "C0332", "no well-formed XML")
            self.assertGreater(found[0]["line"], 3)

    def test_a_library_that_is_none_and_another_token_are_said(self):
        with FmuCell("tank2", description=(HERE / "tank2.xml").read_text(encoding="utf-8").replace("tank-2}", "tank-x}")) as cell:
            self.assertRegex(cell.refused(), "R0155.*C0334.*no instance")
        with FmuCell("tank2", ("area = 0.5", "area = -1.0")) as cell:
            self.assertRegex(cell.refused(), "R0155.*cannot be initialized: area is -1 m2")

    def test_wrong_names_have_their_places(self):
        with FmuCell("tank2", ('full = "%IX4.0"', 'fulll = "%IX4.0"'), ('valve = "%QX0.0"', 'level2 = "%QX0.0"')) as cell:
            found = self.wrong(cell, "C0335", "no variable", "")
            self.assertEqual({each["code"] for each in found}, {"C0335"})
            lines = cell.config.read_text(encoding="utf-8").splitlines()
            for each, name in zip(found, ("fulll", "level2")):
                self.assertIn(name, lines[each["line"] - 1])
        with FmuCell("tank2", ('drain = "%QX0.1"', 'volume = "%QX0.1"'), ('volume = "l"', 'area = "m2"')) as cell:
            self.wrong(cell, "C0335", "an actuator is an input")


if __name__ == "__main__":
    unittest.main()
