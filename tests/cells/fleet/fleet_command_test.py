#!/usr/bin/env python3
"""`stepwright fleet` as a user runs it: the examples, the report, the picture, wrong files, exit codes."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

STEPWRIGHT = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"]) / "stepwright"
CELL = pathlib.Path(__file__).parent
KEYS = {"verdict", "paths", "polygons", "conflicts", "precedences", "paths_ms", "envelopes_ms", "schedule_ms", "retime_ms",
        "allocation", "waits", "bounds", "makespan_ms", "changed_paths"}
PATIENT = ("--time", "100")  # all of these end by a proof, on slow machines later
ENVELOPES = {
    "vehicles": [
        {"name": "v1", "polygons": [{"corners_m": [[0, 0], [5, 0], [5, 2], [0, 2]], "stay_ms": [2000, None],
                                     "overlap_ms": [300, None]},
                                    {"corners_m": [[4, 0], [9, 0], [9, 2], [4, 2]], "stay_ms": [2000, None]}]},
        {"name": "v2", "polygons": [{"corners_m": [[6, 3], [8, 3], [8, 6], [6, 6]], "stay_ms": [1000, None],
                                     "overlap_ms": [100, None]},
                                    {"corners_m": [[6, 1], [8, 1], [8, 4], [6, 4]], "stay_ms": [1000, None],
                                     "overlap_ms": [100, None]},
                                    {"corners_m": [[7, 3], [12, 3], [12, 6], [7, 6]], "stay_ms": [1000, None]}]}],
    "constraints": []}


class FleetCommand(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.cache = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))

    @classmethod
    def tearDownClass(cls) -> None:
        shutil.rmtree(cls.cache)

    def setUp(self) -> None:
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        for file in CELL.glob("*.*"):
            if file.suffix in (".json", ".yaml", ".png"):
                shutil.copy(file, self.folder)

    def tearDown(self) -> None:
        shutil.rmtree(self.folder)

    def fleet(self, problem: str, *options: str) -> subprocess.CompletedProcess:
        return subprocess.run([STEPWRIGHT, "fleet", self.folder / problem, "--cache", self.cache, *options],
                              capture_output=True, text=True, check=False)

    def report(self, problem: str, *options: str) -> dict:
        file = self.folder / "report.json"
        done = self.fleet(problem, "--json", str(file), *PATIENT, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(file.read_text(encoding="utf-8"))

    def change(self, problem: str, old: str, new: str) -> None:
        file = self.folder / problem
        text = file.read_text(encoding="utf-8")
        self.assertIn(old, text)
        file.write_text(text.replace(old, new, 1), encoding="utf-8")

    def test_the_mine_is_scheduled_around_one_vehicle(self) -> None:
        report = self.report("mine.json", "--svg", str(self.folder / "mine.svg"))
        self.assertLessEqual(KEYS, report.keys())
        self.assertEqual(report["verdict"], "scheduled")
        self.assertEqual(len(report["paths"]), 7)
        self.assertEqual(sum(len(v["polygons"]) for v in report["polygons"]), report["polygon_count"])
        self.assertGreater(len(report["precedences"]), 10)
        self.assertGreater(report["changed_paths"][0]["longer_m"], 0)
        for vehicle in report["polygons"]:
            for polygon in vehicle["polygons"]:
                self.assertLessEqual(polygon["earliest_ms"][0], polygon["latest_ms"][0])
        self.assertEqual(len(list(self.cache.glob("*.table"))), 1)
        picture = xml.etree.ElementTree.parse(self.folder / "mine.svg")
        self.assertIn("loader 3", "".join(picture.getroot().itertext()))
        again = self.report("mine.json")
        self.assertEqual(again["precedences"], report["precedences"])

    def test_without_other_paths_there_is_none_and_that_this_is_no_proof_for_all_paths_is_said(self) -> None:
        file = self.folder / "report.json"
        done = self.fleet("mine.json", "--path-factor", "2", "--alternatives", "0", "--json", str(file), *PATIENT)
        self.assertEqual(done.returncode, 4, done.stdout)
        self.assertIn("proved for the paths found, not for all", done.stderr)
        report = json.loads(file.read_text(encoding="utf-8"))
        self.assertEqual((report["verdict"], report["proof"]), ("infeasible", "paths_found"))
        self.assertIn("loader 2 and loader 5 meet at", done.stderr)
        paper = self.fleet("mine.json", "--path-factor", "2", "--paper", "--objective", "none", "--alternatives", "0", *PATIENT)
        self.assertIn(paper.returncode, (0, 4), paper.stderr)

    def test_who_stands_face_to_face_gives_way_if_he_may(self) -> None:
        shutil.copy(CELL / "face_to_face.pgm", self.folder)
        done = self.fleet("face_to_face.json", *PATIENT)
        self.assertEqual(done.returncode, 4, done.stdout)
        report = self.report("face_to_face.json", "--give-way", "1")
        self.assertEqual(report["verdict"], "scheduled")
        self.assertEqual(len(report["ways_given"]), 1)
        # Out of the aisle.
        self.assertFalse(8 < report["ways_given"][0]["x_m"] < 28, report["ways_given"])

    def test_the_warehouse_carries_everything(self) -> None:
        report = self.report("warehouse.json", "--path-factor", "2")
        carried: dict = {}
        for trip in report["allocation"]["trips"]:
            carried[trip["goal"]] = carried.get(trip["goal"], 0) + trip["amount"]
        self.assertEqual(carried, {"flour": 3, "sugar": 1, "order 41": 2, "order 42": 1, "salt": 1})

    def test_an_impossible_deadline_is_named_with_its_line(self) -> None:
        self.change("warehouse.json", '"deadline_ms": 240000', '"deadline_ms": 20000')
        file = self.folder / "report.json"
        done = self.fleet("warehouse.json", "--path-factor", "2", "--json", str(file), *PATIENT)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("there is no schedule, proved", done.stderr)
        self.assertEqual(json.loads(file.read_text(encoding="utf-8"))["proof"], "all_paths")
        self.assertIn("deadline of order 41", done.stderr)

    def test_envelopes_alone_are_scheduled(self) -> None:
        (self.folder / "envelopes.json").write_text(json.dumps(ENVELOPES), encoding="utf-8")
        report = self.report("envelopes.json", "--svg", str(self.folder / "envelopes.svg"))
        self.assertEqual(report["verdict"], "scheduled")
        self.assertEqual(report["allocation"], None)
        self.assertEqual(len(report["precedences"]), 1)
        xml.etree.ElementTree.parse(self.folder / "envelopes.svg")

    def test_wrong_files_are_told_with_all_their_faults(self) -> None:
        self.change("mine.json", '"to": "north 4"', '"to": "nord 4"')
        self.change("mine.json", '"vehicle": "loader 2"', '"vehicle": "loader two"')
        done = self.fleet("mine.json")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"mine\.json:\d+:\d+: F0704: tasks\[0\]\.to: no location is called 'nord 4'")
        self.assertIn("did you mean 'north 4'?", done.stderr)
        self.assertIn("tasks[1].vehicle", done.stderr)
        (self.folder / "mine.png").write_bytes(b"no picture")
        self.assertIn("F0104", self.fleet("mine.json").stderr)

    def test_other_exit_codes(self) -> None:
        self.assertEqual(self.fleet("nowhere.json").returncode, 1)
        self.assertEqual(self.fleet("mine.json", "--time", "0").returncode, 2)
        self.assertEqual(self.fleet("mine.json", "--quickly").returncode, 2)
        self.assertEqual(self.fleet("mine.json", "--time", "0.001").returncode, 4)
        progress = self.fleet("mine.json", "--path-factor", "2", "--progress")
        self.assertIn("s: envelopes", progress.stderr)


if __name__ == "__main__":
    unittest.main()
