"""Plants over shared memory with the real processes: in Python, in C, in ST; they crash, hang, and are wrong."""

import json
import os
import pathlib
import signal
import subprocess
import unittest

from processes import STEPWRIGHT, stepwright
from stepped_cell import SteppedCell, compile_c, gone

NAMES = ("Main.level", "Main.valve", "Main.drain", "Main.filled")
FAR = 20_000  # scans: the tank is filled and kept there
IN_C = ('["python3", "tank.py"]', '["./tank"]')
FAULT = '\n[[faults]]\nat_s = 190.0\nname = "leak"\nvalue = 0.5\n'


def trouble(what, body):
    """The example in Python with `body` in place of what it does at step 50."""
    text = pathlib.Path(__file__).with_name("tank.py").read_text(encoding="utf-8")
    return text.replace("    seconds =", f"    if struct.unpack_from('<Q', area, STEP)[0] == 50:\n        {body}\n    seconds =", 1)


class SharedPlant(unittest.TestCase):
    def run_far(self, *changes, file="by_hand.toml", prepare=None):
        with SteppedCell(file, *changes) as cell:
            if prepare:
                prepare(cell)
            cell.run()
            cell.step_to(FAR)
            return cell.values(*NAMES)

    def test_a_plant_in_python_fills_and_the_same_seed_gives_the_same_values(self):
        first = self.run_far()
        self.assertEqual(self.run_far(), first)
        self.assertAlmostEqual(int(first[0]), 20736, delta=300)
        self.assertEqual(first[3], "TRUE")

    def test_a_plant_in_c_does_the_same(self):
        level, _, _, filled = self.run_far(IN_C, prepare=compile_c)
        self.assertAlmostEqual(int(level), 20736, delta=30)
        self.assertEqual(filled, "TRUE")

    def test_a_plant_in_st_does_the_same(self):
        level, _, _, filled = self.run_far(file="st.toml")
        self.assertAlmostEqual(int(level), 20736, delta=30)
        self.assertEqual(filled, "TRUE")

    def test_a_fault_reaches_the_plant(self):
        for file, changes, prepare in (("by_hand.toml", (), None), ("by_hand.toml", (IN_C,), compile_c), ("st.toml", (), None)):
            name = "Tank.leak" if file == "st.toml" else "leak"
            with self.subTest(file=file, changes=changes):
                level = self.run_far(*changes, ("\n[runtime]", FAULT.replace("leak", name) + "\n[runtime]"), file=file, prepare=prepare)[0]
                self.assertLess(int(level), 100)

    def test_a_fault_is_made_and_ended_by_command(self):
        with SteppedCell("by_hand.toml") as cell:
            cell.run()
            cell.step(7_000)
            full = int(cell.values(*NAMES)[0])
            cell.ask("fault", "leak", "0.05", "--config", cell.config)
            cell.step(2_000)
            low = int(cell.values(*NAMES)[0])
            self.assertLess(low, full / 2)
            cell.ask("fault", "leak", "--clear", "--config", cell.config)
            cell.step(2_000)
            self.assertGreater(int(cell.values(*NAMES)[0]), low + 1_000)
            refused = stepwright("fault", "flood", "1", "--config", cell.config)
            self.assertEqual(refused.returncode, 1)
            self.assertIn("C0311", refused.stderr)

    def test_the_plant_is_killed_in_the_middle_and_the_runtime_stays(self):
        with SteppedCell("by_hand.toml") as cell:
            cell.run()
            cell.step(100)
            self.assertEqual(cell.values("%QX0.0"), ["TRUE"])
            plant = cell.plant_process()
            os.kill(plant, signal.SIGKILL)
            self.assertTrue(gone(plant))
            cell.runtime.wait_for(r"the plant is lost at [\d.]+ s: its process was killed by signal 9")
            said = cell.ask("step", "3", "--config", cell.config)
            self.assertIn("the plant is lost", said)
            self.assertEqual(cell.values("%QX0.0"), ["FALSE"])
            self.assertTrue(cell.runtime.running())
            self.assertEqual(cell.runtime.end(), 0)
            cell.run()  # another runtime, another plant, from its beginning
            self.assertNotEqual(cell.plant_process(), plant)

    def test_the_plant_hangs_and_the_wait_is_bounded(self):
        with SteppedCell("by_hand.toml", ("[plant]\n", "[plant]\ntimeout_ms = 300\n")) as cell:
            cell.run()
            cell.step(10)
            plant = cell.plant_process()
            os.kill(plant, signal.SIGSTOP)
            said = cell.ask("step", "3", "--config", cell.config)
            self.assertIn("does not answer", said)
            cell.runtime.wait_for(r"no answer to a step within 300 ms; its process was killed")
            self.assertTrue(gone(plant))
            self.assertEqual(cell.values("%QX0.0"), ["FALSE"])

    def test_what_a_plant_does_wrong_while_it_runs_is_said(self):
        for body, said in (("answer('the pump is dry'); break", "the plant is lost at 0.500 s: the pump is dry"),
                           ("put('sensor', 'level', float('nan')); answer(); continue", "'level' is no finite number"),
                           ("runtime.send(b'rr'); continue", "before its step was done"),
                           ("sys.exit(3)", "its process ended with exit code 3"),
                           ("area[0:512] = bytes(range(256)) * 2", "the plant is lost"),
                           ("os.ftruncate(4, 64)", "ended with exit code 1")):
            with self.subTest(body=body), SteppedCell("by_hand.toml") as cell:
                text = trouble(said, body).replace("import mmap", "import mmap\nimport os", 1)
                (cell.folder / "tank.py").write_text(text, encoding="utf-8")
                cell.run()
                cell.ask("step", "100", "--config", cell.config)
                cell.runtime.wait_for(said.replace("(", r"\("))
                self.assertTrue(cell.runtime.running())

    def test_a_plant_that_cannot_begin_is_refused_with_its_place(self):
        wrong = (('VERSION = b"SWPLANT1", 1', 'VERSION = b"SWPLANT1", 7', "exit|version"),
                 ("<II\", area, PEER_VERSION, VERSION", "<II\", area, PEER_VERSION, 7", "R0154.*version 7"),
                 ("size > len(area)", "size < 10**9", "R0153.*exit code 1"),
                 ("answer()                                         # ready", "answer('no water today')  #", "R0155.*no water today"))
        for old, new, said in wrong:
            with self.subTest(new=new), SteppedCell("by_hand.toml") as cell:
                text = (cell.folder / "tank.py").read_text(encoding="utf-8")
                self.assertIn(old, text)
                (cell.folder / "tank.py").write_text(text.replace(old, new, 1), encoding="utf-8")
                output = cell.refused()
                self.assertRegex(output, said)
                self.assertRegex(output, r"cell\.toml:\d+:\d+: R015")

    def test_a_plant_that_is_never_ready_is_not_waited_for_without_end(self):
        with SteppedCell("by_hand.toml", ('["python3", "tank.py"]', '["sleep", "1000"]'),
                         ("[plant]\n", "[plant]\nstart_timeout_ms = 300\n")) as cell:
            self.assertIn("not ready within 300 ms", cell.refused())

    def test_the_wrong_configuration_has_its_places(self):
        lines = {'full = "%IX4.0"': ('full = "%IX400.0"', "C0303"),
                 'valve = "%QX0.0"': ('valve = "%IX5.0"', "C0306"),
                 'drain = "%QX0.1"': ('drain = "%QX0.0"', "C0304"),
                 'range = [0.0, 2.0]': ('range = [2.0, 2.0]', "C0006"),
                 'command = ["python3", "tank.py"]': ('command = ["no-such-program"]', "R0153"),
                 'volume = "l"': ('level = "l"', "C0006")}
        for old, (new, code) in lines.items():
            with self.subTest(new=new), SteppedCell("by_hand.toml", (old, new)) as cell:
                exit_code, found = cell.check()
                self.assertEqual(exit_code, 1)
                self.assertIn(code, [each["code"] for each in found], found)
                text = cell.config.read_text(encoding="utf-8").splitlines()
                line = next(each["line"] for each in found if each["code"] == code)
                self.assertIn(new.split("=", maxsplit=1)[0].strip(), text[line - 1])
        with SteppedCell("by_hand.toml", ("[plant.faults]", "[plant.more]\nx = 1\n[plant.faults]"),
                         ("\n[runtime]", FAULT.replace("leak", "leek") + "\n[runtime]")) as cell:
            codes = [each["code"] for each in cell.check()[1]]
            self.assertIn("C0002", codes)
            self.assertIn("C0311", codes)

    def test_wrong_names_of_a_plant_in_st_have_their_places(self):
        with SteppedCell("st.toml", ('"Tank.full"', '"Tank.ful"')) as cell:
            code, found = cell.check()
            self.assertEqual(code, 1)
            self.assertEqual(found[0]["code"], "C0336")
            self.assertIn("Tank.full", found[0]["hint"])
            self.assertIn("R0155", cell.refused())
        with SteppedCell("st.toml") as cell:
            self.assertEqual(cell.check()[0], 0)
            (cell.folder / "tank_model.st").write_text("PROGRAM Tank\nVAR x : NOTHING; END_VAR\nEND_PROGRAM\n", encoding="utf-8")
            self.assertEqual(cell.check()[0], 1)

    def test_a_trap_of_a_plant_in_st_costs_the_plant(self):
        with SteppedCell("st.toml") as cell:
            text = (cell.folder / "tank_model.st").read_text(encoding="utf-8")
            text = text.replace("    volume : LREAL;", "    n : INT;\n    volume : LREAL;").replace(
                "    level := level - leak", "    n := 100 / (60 - n);\n    n := 60;\n    level := level - leak")
            (cell.folder / "tank_model.st").write_text(text, encoding="utf-8")
            cell.run()
            cell.ask("step", "100", "--config", cell.config)
            cell.runtime.wait_for(r"the plant is lost at [\d.]+ s: .*tank_model\.st:\d+")

    def test_the_demo_reaches_its_goal_and_the_trace_is_the_same_again(self):
        hashes = []
        for _ in range(2):
            with SteppedCell("cell.toml") as cell:
                report = cell.folder / "report.json"
                done = subprocess.run([STEPWRIGHT, "demo", cell.config, "--headless", "--fast", "--json", report],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                found = json.loads(report.read_text(encoding="utf-8"))
                self.assertTrue(found["goal_reached"])
                hashes.append(found["trace_hash"])
        self.assertEqual(hashes[0], hashes[1])

    def test_a_recording_of_it_is_replayed_without_the_plant(self):
        with SteppedCell("by_hand.toml", ("\n[runtime]", '\n[record]\nfile = "run.swrec"\n[runtime]')) as cell:
            cell.run()
            cell.step_to(1000 + cell.scan)
            cell.runtime.end()
            found = list(cell.folder.rglob("run.swrec"))
            self.assertEqual(len(found), 1)
            done = stepwright("replay", found[0])
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
