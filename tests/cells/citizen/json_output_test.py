"""Standard output of every command: with --json it is one JSON document and nothing else, whatever the input is like; what it does
not take is told."""

import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from kept_cell import NO_PLANT, PAGE, KeptCell
from processes import SOURCES, STEPWRIGHT, stepwright

CELLS = SOURCES / "tests/cells"
BENCH = CELLS / "bench"
ARM = CELLS / "robot_cell"
# Simulated time, so that it can be stepped.
RUNS = '[clock]\nmode = "simulated"\nspeed = 1.0\n[runtime]\nsources = ["main.st"]\nautostart = true\n'
TEST = "PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\nTEST 'it counts'\nRUN_SCANS(2);\nASSERT_EQ(2, Main.n);\nEND_TEST\n"


def with_json():
    """Names of the commands, and of commands of commands, whose help names --json."""
    def help_of(*words):
        return stepwright(*words, "--help").stdout

    found = set()
    for name in re.findall(r"^  ([a-z][\w-]*) ", help_of(), re.M):
        text = help_of(name)
        if re.search(r"^  --json\b", text, re.M):
            found.add(name)
        inner = re.search(r"^Subcommands:\n((?:  .*\n?)+)", text, re.M)
        for each in re.findall(r"^  ([a-z][\w-]*) ", inner[1], re.M) if inner else []:
            if re.search(r"^  --json\b", help_of(name, each), re.M):
                found.add(f"{name} {each}")
    return found


class JsonOutput(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        (cls.folder / "main.st").write_text(TEST, encoding="utf-8")
        (cls.folder / "trace.csv").write_text("scan,a\n1,0\n2,1\n", encoding="utf-8")
        (cls.folder / "bad.toml").write_text("[cell\n", encoding="utf-8")
        image, plan = cls.folder / "main.swb", cls.folder / "plan"
        cls.done("compile", cls.folder / "main.st", "-o", image)
        cls.done("plan", BENCH / "domain.pddl", BENCH / "problem.pddl", "--first", "--out", plan)
        cls.cell = KeptCell(more=NO_PLANT + RUNS + PAGE)
        cls.addClassCleanup(cls.cell.__exit__)
        cls.cell.ready()
        kept = ("--config", cls.cell.config)
        recording = cls.folder / "cell.rec"
        cls.done("record", *kept, recording, "--seconds", "0.3")
        problem = (BENCH / "domain.pddl", BENCH / "problem.pddl")
        robot = (ARM / "two_arms.urdf", ARM / "table.toml", ARM / "swing.yaml", "--srdf", ARM / "two_arms.srdf", "--protrusion", "0.06")
        # What each is given: input that is right, and input that is not.
        cls.given = {
            "arm": (robot, ("nosuch.urdf", *robot[1:])),
            "binding try": (("bench", "--most", "1"), ("nosuch",)),
            "campaign": (("bench", "--runs", "1", "--faults", "none"), ("nosuch",)),
            "check": ((BENCH / "cell.toml",), (cls.folder / "bad.toml",)),
            "compile": ((cls.folder / "main.st", "-o", image), ("nosuch.st", "-o", image)),
            "demo": (("bench", "--headless", "--fast", "--no-compare"), ("nosuch",)),
            "download": ((*kept, image, "--replace"), (*kept, "nosuch.swb")),
            "exec": ((image, "--scans", "3", "--trace", "Main.n"), ("nosuch.swb",)),
            "fleet": ((CELLS / "fleet/hall.json",), ("nosuch.json",)),
            "forces": (kept, ("--config", "nosuch.toml")),
            "htn": ((CELLS / "htn/bar.hddl", CELLS / "htn/evening.hddl"), ("nosuch.hddl", "nosuch.hddl")),
            "ltl check": (("F a", cls.folder / "trace.csv"), ("F (a", cls.folder / "trace.csv")),
            "ltl plan": ((CELLS / "ltl/blocks.json",), ("nosuch.json",)),
            "modbus-client": (None, ("--status", "--config", "nosuch.toml")),
            "plan": ((*problem, "--first"), ("nosuch.pddl", "nosuch.pddl")),
            "plant": ((CELLS / "bench_model/plant.toml",), ("nosuch.toml",)),
            "reach": ((CELLS / "reach/two_arms.toml",), ("nosuch.toml",)),
            "record": ((*kept, "--status"), ("--config", "nosuch.toml", "--status")),
            "reference": ((), None),
            "replay": ((recording,), ("nosuch.rec",)),
            "scan-test": (("--seconds", "0.2"), ("nosuch.swb",)),
            "snapshot": (kept, (*kept, "nosuch")),
            "status": ((cls.cell.config,), ("nosuch.toml",)),
            "step": ((*kept, "2", "--changes"), ("--config", "nosuch.toml")),
            "tamp": ((ARM / "tamp_p1.toml",), ("nosuch.toml",)),
            "test": ((cls.folder / "main.st",), ("nosuch.st",)),
            "validate": ((*problem, plan), (*problem, "nosuch")),
            "watch": ((*kept, "Main.n", "--count", "2", "--period", "20"), (*kept, "nosuch", "--count", "1")),
        }

    @classmethod
    def done(cls, *command):
        result = stepwright(*command)
        assert result.returncode == 0, result.stdout + result.stderr

    def run_with_json(self, name, arguments):
        # Of these the option has no value: they write nothing but what they are asked for.
        place = () if name in ("reference", "status") else ("-",)
        return stepwright(*name.split(), *arguments, "--json", *place)

    def test_every_command_with_json_is_here(self):
        self.assertEqual(with_json(), set(self.given))

    def test_right_input_gives_one_document(self):
        for name, (right, _) in self.given.items():
            if right is None:
                continue
            with self.subTest(command=name):
                result = self.run_with_json(name, right)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                self.assertIsInstance(json.loads(result.stdout), dict)

    def test_wrong_input_gives_one_document_or_none(self):
        for name, (_, wrong) in self.given.items():
            if wrong is None:
                continue
            with self.subTest(command=name):
                result = self.run_with_json(name, wrong)
                self.assertNotEqual(result.returncode, 0, result.stdout)
                self.assertNotEqual(result.stderr, "")
                if result.stdout:
                    json.loads(result.stdout)

    def test_words_for_people_are_not_lost(self):
        result = self.run_with_json("check", (BENCH / "cell.toml",))
        self.assertIn("cell.toml: sound\n", result.stderr)
        self.assertIn("plan: ", result.stderr)

    def test_standard_output_may_be_a_file(self):
        file = self.folder / "report.json"
        for spelling in (("--json", "-"), ("--json=-",)):
            with open(file, "wb") as out:
                subprocess.run([STEPWRIGHT, "check", BENCH / "cell.toml", *spelling], stdout=out, stderr=subprocess.DEVNULL, check=True)
            self.assertTrue(json.loads(file.read_text(encoding="utf-8"))["sound"])

    def test_a_full_disk_is_told_by_every_command(self):
        commands = [("--help",)] + [(name, "--help") for name in re.findall(r"^  ([a-z][\w-]*) ", stepwright("--help").stdout, re.M)]
        commands += [("explain", "E0110"), ("check", BENCH / "cell.toml"), ("plant", CELLS / "bench_model/plant.toml"), ("status", self.cell.config)]
        for command in commands:
            with self.subTest(command=command), open("/dev/full", "wb") as full:
                result = subprocess.run([STEPWRIGHT, *command], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn("E0002: standard output cannot be written: No space left on device", result.stderr)

    def test_a_reader_that_has_gone_is_no_error(self):
        result = subprocess.run(f"{STEPWRIGHT} plant --types | true", shell=True, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
