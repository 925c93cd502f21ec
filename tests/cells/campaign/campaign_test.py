"""Campaigns of cells: with and without a planner, on every kind of plant; verdicts, repetition by seed, wrong input."""

import contextlib
import json
import os
import pathlib
import shutil
import tempfile
import time
import unittest

from processes import SOURCES, stepwright

CELLS = SOURCES / "tests/cells"
NEVER_FILLED = '[[monitors]]\nname = "never_filled"\nformula = "never filled"\nlet = { filled = "Main.filled" }\n'


def processes_with(argument):
    """Numbers of the processes that were called with it."""
    found = []
    for line in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            if argument.encode() in line.read_bytes().split(b"\0"):
                found.append(int(line.parent.name))
    return found


class Campaign(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_campaign(self, *arguments, code=0):
        report = self.folder / "figures.json"
        done = stepwright("campaign", *arguments, "--json", report)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return json.loads(report.read_text(encoding="utf-8")), done.stdout

    def copy_of_tank(self, name, more=""):
        shutil.copytree(CELLS / "shared_plant", self.folder / "tank")
        cell = self.folder / "tank" / name
        cell.write_text(cell.read_text(encoding="utf-8") + more, encoding="utf-8")
        return cell

    def test_a_planned_cell_reaches_its_goal_or_stops_safely(self):
        figures, text = self.run_campaign("bench_model", "--runs", 6, "--seed", 1)
        self.assertEqual(figures["runs"], 6)
        self.assertEqual(figures["goal"] + figures["safe"], 6, text)
        self.assertEqual(figures["undisturbed"]["verdict"], "goal")
        self.assertGreater(figures["faults_offered"], 20)

    def test_a_seed_repeats_its_run(self):
        first, _ = self.run_campaign("bench_model", "--only", 3)
        again, _ = self.run_campaign("bench_model", "--only", 3)
        other, _ = self.run_campaign("bench_model", "--only", 4)
        self.assertEqual(first["runs"], 1)
        self.assertEqual(first["last"]["trace_hash"], again["last"]["trace_hash"])
        self.assertEqual(first["last"]["faults"], again["last"]["faults"])
        self.assertNotEqual(first["last"]["trace_hash"], other["last"]["trace_hash"])

    def test_a_program_by_hand_on_a_plant_in_python_holds(self):
        figures, text = self.run_campaign(CELLS / "shared_plant/by_hand.toml", "--runs", 3, "--seconds", 20)
        self.assertFalse(figures["planned"])
        self.assertEqual(figures["goal"], 3, text)
        self.assertEqual(figures["faults_offered"], 1)

    def test_a_program_by_hand_on_a_plant_in_st_holds(self):
        figures, text = self.run_campaign(CELLS / "shared_plant/st.toml", "--runs", 3, "--seconds", 20)
        self.assertEqual(figures["goal"], 3, text)

    def test_a_monitor_that_fails_is_a_violation_with_the_seed_that_repeats_it(self):
        cell = self.copy_of_tank("st.toml", NEVER_FILLED)
        figures, text = self.run_campaign(cell, "--runs", 2, "--seconds", 120, "--faults", "none", code=5)
        self.assertEqual(figures["violated"], 2, text)
        self.assertEqual(figures["causes"], {"violated: monitor never_filled": 2})
        seed = figures["failures"][0]["seed"]
        again, text = self.run_campaign(cell, "--only", seed, "--seconds", 120, "--faults", "none", code=5)
        self.assertEqual(again["last"]["verdict"], "violated")
        self.assertIn("monitor 'never_filled' failed", text)

    def test_a_plant_whose_process_dies_is_told_with_what_it_printed_by_seed(self):
        cell = self.copy_of_tank("by_hand.toml")
        tank = cell.parent / "tank.py"
        text = tank.read_text(encoding="utf-8")
        dies = '    if struct.unpack_from("<q", area, TIME)[0] > 2_000_000_000:\n        raise ValueError("the pump has burst")\n'
        line = '    seconds = struct.unpack_from("<q", area, STEP_LENGTH)[0] * 1e-9\n'
        self.assertIn(line, text)
        tank.write_text(text.replace(line, dies + line), encoding="utf-8")
        figures, text = self.run_campaign(cell, "--runs", 2, "--seconds", 20, "--faults", "none", code=5)
        self.assertEqual(figures["causes"], {"lost: plant lost": 2}, text)
        for run in figures["failures"]:
            self.assertRegex(run["why"], r"the plant is lost at 2\.\d+ s: its process ended with exit code 1")
            self.assertTrue(run["printed"].endswith("ValueError: the pump has burst"), run)
        self.assertRegex(text, r"(?s)seed 1: lost.*ValueError: the pump has burst.*seed 2: lost.*ValueError: the pump has burst")

    def test_a_plant_that_refuses_a_seed_is_lost(self):
        cell = self.copy_of_tank("by_hand.toml")
        tank = cell.parent / "tank.py"
        text = tank.read_text(encoding="utf-8")
        line = "level_m, noise = "
        self.assertIn(line, text)
        refuses = 'if seed == 12:\n    print("nothing more is printed", flush=True)\n    answer("no valve")\n    sys.exit(1)\n'
        tank.write_text(text.replace(line, refuses + line), encoding="utf-8")
        figures, text = self.run_campaign(cell, "--runs", 3, "--seed", 11, "--seconds", 5, "--faults", "none", code=5)
        self.assertEqual(figures["causes"], {"lost: plant lost": 1}, text)
        [lost] = figures["failures"]
        self.assertEqual((lost["seed"], lost["printed"]), (12, "nothing more is printed"))
        self.assertIn("R0155: the plant cannot run: no valve", lost["why"])

    def test_what_a_plant_has_started_ends_with_its_run(self):
        cell = self.copy_of_tank("by_hand.toml")
        tank = cell.parent / "tank.py"
        mark = f"{os.getpid()}.{time.monotonic_ns()}"
        start = f'import subprocess\nfor own in (False, True):\n    subprocess.Popen(["sh", "-c", "sleep 987; exit", "{mark}"], start_new_session=own)\n'
        tank.write_text(start + tank.read_text(encoding="utf-8"), encoding="utf-8")
        # The pipe ends: nobody holds the output any more.
        self.run_campaign(cell, "--runs", 2, "--seconds", 5, "--faults", "none")
        self.assertEqual(processes_with(mark), [])

    def test_a_limit_of_a_time_is_in_seconds(self):
        (self.folder / "alarms.toml").write_text(
            "".join(f'[[alarm]]\nname = "after_{limit}"\nsource = "Main.ran"\nwhen = "high"\nlimit = {limit}\n' for limit in (2, 3_000)), encoding="utf-8")
        cell = self.write_cell('[plant]\nkind = "tank_bench"\n[runtime]\nsources = ["main.st"]\n[history]\nfolder = "h"\nalarms = "alarms.toml"\n')
        (self.folder / "main.st").write_text("PROGRAM Main\nVAR ran : TIME; END_VAR\nran := ran + T#10ms;\nEND_PROGRAM\n", encoding="utf-8")
        figures, text = self.run_campaign(cell, "--only", 1, "--seconds", 5, "--faults", "none")
        self.assertEqual(figures["last"]["alarms"], ["after_2"], text)

    def test_a_plant_that_cannot_be_solved_is_told_as_that(self):
        plant = '[types.bomb]\nparameters.tick = { unit = "s", default = "1 s" }\nstates.x = { start = "1", derivative = "x * x / tick" }\n'
        plant += 'outputs.hot = { switch = true, value = "x > 2" }\n[components.b]\ntype = "bomb"\n[terminals]\nHOT = { address = "%IX0.0", from = "b.hot" }\n'
        (self.folder / "plant.toml").write_text(plant, encoding="utf-8")
        (self.folder / "main.st").write_text("PROGRAM Main VAR hot AT %IX0.0 : BOOL; seen : BOOL; END_VAR seen := hot; END_PROGRAM\n", encoding="utf-8")
        cell = self.write_cell('[plant]\nkind = "model"\nfile = "plant.toml"\n[runtime]\nsources = ["main.st"]\n')
        figures, text = self.run_campaign(cell, "--runs", 1, "--seconds", 20, code=5)
        self.assertEqual(figures["undisturbed"]["cause"], "plant lost", text)
        self.assertIn("the plant's solver gave up", figures["undisturbed"]["why"])

    def test_faults_are_listed_and_chosen_by_name(self):
        listed = stepwright("campaign", "bench_model", "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertIn("a1.leak", listed.stdout)
        figures, _ = self.run_campaign("bench_model", "--runs", 1, "--faults", "a1.*")
        self.assertLess(figures["faults_offered"], 5)

    def test_wrong_input_is_told(self):
        for arguments, word in (
            (["nosuchcell"], "M0002"),
            (["bench_model", "--faults", "flood"], "C0311"),
            ([self.write_cell('[plant]\nkind = "none"\n[runtime]\nsources = ["main.st"]\n')], "C0448"),
            ([self.write_cell('[plant]\nkind = "tank_bench"\n')], "M0041"),
            ([self.write_cell('[plant]\nkind = "tank_bench"\n[runtime]\nsources = ["broken.st"]\n')], "broken.st"),
        ):
            done = stepwright("campaign", *arguments)
            self.assertEqual(done.returncode, 1, (arguments, done.stdout, done.stderr))
            self.assertIn(word, done.stderr)

    def write_cell(self, text):
        (self.folder / "main.st").write_text("PROGRAM Main\nVAR x : BOOL; END_VAR\nx := TRUE;\nEND_PROGRAM\n", encoding="utf-8")
        (self.folder / "broken.st").write_text("PROGRAM Main\nx := ;\nEND_PROGRAM\n", encoding="utf-8")
        cell = self.folder / f"cell{len(list(self.folder.iterdir()))}.toml"
        cell.write_text('[cell]\nname = "trial"\n' + text, encoding="utf-8")
        return cell

    def test_nothing_is_left_behind(self):
        temporary = self.folder / "tmp"
        temporary.mkdir()
        done = stepwright("campaign", CELLS / "shared_plant/st.toml", "--runs", 2, "--seconds", 5,
                          env={**os.environ, "TMPDIR": str(temporary)})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(list(temporary.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
