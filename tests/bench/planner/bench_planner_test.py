#!/usr/bin/env python3
"""bench_planner as a user runs it: the keys of its report, the curves, the instances as files, wrong options."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BENCH = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"]) / "bench_planner"
PLANNER = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"]) / "stepwright"


class BenchPlanner(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def bench(self, *options: str) -> subprocess.CompletedProcess:
        return subprocess.run([BENCH, *options], capture_output=True, text=True)

    def test_table_of_two_domains_has_the_promised_keys(self) -> None:
        report = self.folder / "report.json"
        done = self.bench("--domains", "blocks,counters", "--sizes", "2", "--time", "1", "--repeats", "1",
                          "--json", str(report))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("blocks-2-1", done.stdout)
        figures = json.loads(report.read_text(encoding="utf-8"))
        self.assertGreater(figures["grounding_ms_bench"], 0)
        self.assertGreater(figures["optimal_ms_bench"], 0)
        self.assertEqual(sorted(figures["domains"]), ["blocks", "counters"])
        for domain in figures["domains"].values():
            self.assertEqual((domain["solved"], domain["instances"]), (2, 2))
            self.assertGreater(domain["first_plan_ms_median"], 0)
            self.assertGreaterEqual(domain["cost_ratio_to_best_known"], 1)
            self.assertEqual(domain["baseline"]["solved"], 2)
            self.assertEqual([at["time_s"] for at in domain["quality_over_time"]], [0.01, 0.1])
            self.assertLessEqual(domain["quality_over_time"][-1]["solved"], 2)
        for instance in figures["instances"]:
            profile = instance["cost_over_time"]
            costs = [found["plan_cost"] for found in profile]
            self.assertEqual(costs, sorted(costs, reverse=True))
            self.assertEqual(profile[-1]["plan_cost"], instance["plan_cost"])
            self.assertLessEqual(instance["best_known_cost"], instance["plan_cost"])
            self.assertGreater(instance["peak_mb"], 0)

    def test_scale_writes_a_curve_and_its_picture(self) -> None:
        report = self.folder / "curves.json"
        done = self.bench("--scale", "--domains", "tank_bench_1", "--time", "0.2", "--svg", str(self.folder),
                          "--json", str(report))
        self.assertEqual(done.returncode, 0, done.stderr)
        curve = json.loads(report.read_text(encoding="utf-8"))["curves"]["tank_bench_1"]
        self.assertEqual(curve["points"][0]["size"], 2)
        self.assertTrue(curve["planner_ended"])
        self.assertIn("</svg>", (self.folder / "tank_bench_1.svg").read_text(encoding="utf-8"))

    def test_instances_as_files_are_what_stepwright_reads(self) -> None:
        self.assertEqual(self.bench("--domains", "courier", "--sizes", "1", "--write", str(self.folder)).returncode, 0)
        files = [str(self.folder / f"courier-1-1.{part}") for part in
                 ("domain.pddl", "problem.pddl", "reference.plan")]
        done = subprocess.run([PLANNER, "validate", *files], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_wrong_options_are_told(self) -> None:
        unknown = self.bench("--domains", "chess")
        self.assertEqual(unknown.returncode, 1)
        self.assertIn("chess", unknown.stderr)
        self.assertIn("logistics", unknown.stderr)
        self.assertEqual(self.bench("--quickly").returncode, 2)
        self.assertEqual(self.bench("--outside", "nameless").returncode, 2)
        for option, value in (("--time", "nan"), ("--time", "-1"), ("--sizes", "0"), ("--memory", "-1"),
                              ("--repeats", "0")):
            self.assertEqual(self.bench(option, value).returncode, 2, (option, value))
        unwritable = self.bench("--domains", "blocks", "--json", "/nonexistent/report.json")
        self.assertEqual(unwritable.returncode, 1)
        self.assertIn("/nonexistent/report.json: E0002", unwritable.stderr)
        self.assertEqual(unwritable.stdout, "")


if __name__ == "__main__":
    unittest.main()
