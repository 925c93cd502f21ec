"""The bench's main job on a plant that is described by components, with all its real processes."""

import json
import pathlib
import shutil
import sys
import tempfile
import unittest
from xml.etree import ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bench"))
from cell_process import TIME_TO_PROVE, Demo, stepwright  # noqa: E402  (found by the line above)

CELL = pathlib.Path(__file__).resolve().parent / "cell.toml"


class BenchModel(unittest.TestCase):
    def run_demo(self, *arguments):
        with Demo("--fast", "--no-compare", *arguments, cell=CELL) as demo:
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        return report

    def test_the_goal_is_reached_as_on_the_built_in_bench(self):
        report = self.run_demo("--seed", 3, *TIME_TO_PROVE)
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["plan_steps"], 17)
        self.assertEqual(report["replans"], 0)
        self.assertAlmostEqual(report["level_a1_percent"], 50, delta=2)
        self.assertAlmostEqual(report["level_a2_percent"], 50, delta=2)

    def test_the_same_seed_leaves_the_same_trace(self):
        first, second, other = (self.run_demo("--seed", seed) for seed in (5, 5, 6))
        self.assertEqual(first["trace_hash"], second["trace_hash"])
        self.assertNotEqual(first["trace_hash"], other["trace_hash"])

    def test_a_fault_of_a_component_is_scheduled_by_its_name(self):
        with Demo("--fast", "--no-compare", "--seed", 3, "--set", 'faults=[{at_s=5.0, name="a1.leak", value=0.3}]',
                  cell=CELL) as demo:
            report, code = demo.result()
        self.assertEqual(code, 5, report["stdout"])
        self.assertIn("level of a1 has fallen by itself", report["message"])

    def test_a_misspelt_fault_is_found_before_anything_runs(self):
        run = stepwright("check", "--config", CELL, "--set", 'faults=[{at_s=5.0, name="a1.leek", value=0.3}]')
        self.assertEqual(run.returncode, 1)
        self.assertIn("C0311", run.stdout + run.stderr)
        self.assertIn("a1.leak", run.stdout + run.stderr)

    def test_the_file_of_the_plant_is_checked_with_the_cell(self):
        run = stepwright("check", "--config", CELL, "--set", "plant.file=cell.toml")
        self.assertEqual(run.returncode, 1)
        self.assertIn("C0006", run.stdout + run.stderr)


class PlantCommand(unittest.TestCase):
    PLANT = CELL.parent / "plant.toml"

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_it_lists_what_the_plant_has(self):
        run = stepwright("plant", self.PLANT, "--json", self.folder / "plant.json")
        self.assertEqual(run.returncode, 0, run.stderr)
        for word in ("fc1", "%IX0.0", "a1.level", "b1.weak", "times real time"):
            self.assertIn(word, run.stdout)
        plant = json.loads((self.folder / "plant.json").read_text(encoding="utf-8"))
        self.assertEqual(plant["states"], 13)
        self.assertIn({"name": "S1", "address": "%IW1"}, plant["sensors"])
        self.assertGreater(plant["realtime_factor"], 0)

    def test_a_step_answer_is_a_table_and_a_picture(self):
        run = stepwright("plant", self.PLANT, "--set", "B1=1@1", "--set", "B1=0@3", "--fault", "v1.leak=2@5", "--seconds", 8,
                         "--value", "v1.level", "--value", "b1.flow", "--csv", self.folder / "a.csv", "--svg", self.folder / "a.svg")
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = [line.split(",") for line in (self.folder / "a.csv").read_text(encoding="utf-8").splitlines()]
        self.assertEqual(rows[0], ["time_s", "v1.level [percent]", "b1.flow [l/s]"])
        self.assertEqual(len(rows), 802)
        level = {round(float(row[0]), 2): float(row[1]) for row in rows[1:]}
        self.assertAlmostEqual(level[1.0], 20.0)
        self.assertGreater(level[4.0], 30.0)
        self.assertAlmostEqual(level[5.0] - level[8.0], 6.0, delta=0.1)
        picture = ElementTree.parse(self.folder / "a.svg")
        self.assertEqual(len(picture.findall(".//{http://www.w3.org/2000/svg}polyline")), 2)

    def test_what_is_wrong_is_said_with_its_place(self):
        for arguments, words in ((("--set", "B9=1"), "B1"), (("--set", "B1"), "C0350"), (("--fault", "v1.leek=1"), "v1.leak"),
                                 (("--value", "v1.levle", "--csv", self.folder / "a.csv"), "v1.level")):
            run = stepwright("plant", self.PLANT, *arguments)
            self.assertEqual(run.returncode, 1, arguments)
            self.assertIn(words, run.stderr)
        broken = self.folder / "plant.toml"
        broken.write_text(self.PLANT.read_text(encoding="utf-8").replace('volume = "20 l"', 'volume = "20 s"'), encoding="utf-8")
        run = stepwright("plant", broken)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"plant.toml:\d+:\d+: .*C0341")
        self.assertEqual(stepwright("plant").returncode, 2)

    def test_the_types_are_those_of_the_document(self):
        run = stepwright("plant", "--types")
        types = [line.split(":")[0] for line in run.stdout.splitlines() if not line.startswith(" ")]
        self.assertGreaterEqual(len(types), 25)
        self.assertIn("how flow follows position (linear, equal_percentage)", run.stdout)
        document = (CELL.parents[3] / "plant_models/doc/components.md").read_text(encoding="utf-8")
        for name in types:
            self.assertIn(f"`{name}`", document)


if __name__ == "__main__":
    unittest.main()
