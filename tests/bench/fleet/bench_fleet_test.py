#!/usr/bin/env python3
"""bench_fleet as a user runs it, on few and small instances: the keys of its report, no disagreement, wrong options."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

BENCH = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"]) / "bench_fleet"


class BenchFleet(unittest.TestCase):
    def bench(self, *options: str) -> subprocess.CompletedProcess:
        return subprocess.run([BENCH, *options], capture_output=True, text=True, check=False)

    def test_verdicts_agree_and_the_report_is_whole(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            done = self.bench("--runs", "3", "--most", "8", "--cap", "0.02", "--scale", "100",
                              "--json", str(folder / "report.json"), "--svg", str(folder / "figure.svg"))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            figures = json.loads((folder / "report.json").read_text(encoding="utf-8"))
            xml.etree.ElementTree.parse(folder / "figure.svg")
        self.assertEqual(figures["referee_disagreements"], 0)
        self.assertEqual(figures["baseline_disagreements"], 0)
        self.assertEqual(figures["checker_faults"], 0)
        self.assertEqual(figures["instances"], 7 * 3)
        for key in ("mean_ms", "p99_ms", "ratio_to_paper_fair_n8", "vehicles_100_ms",
                    "mine_total_ms", "mine_baseline_ms", "new_goal_ms"):
            self.assertGreater(figures[key], 0.0, key)
        # Both answers occur, or the referee would prove little.
        self.assertGreater(sum(row["scheduled"] for row in figures["circles"]), 4)
        self.assertGreater(sum(row["infeasible"] for row in figures["circles"]), 2)
        self.assertTrue(all(row["scheduled"] for row in figures["warehouses"]))
        self.assertTrue(figures["mine_scheduled"])
        self.assertEqual(figures["new_goals"], 14)
        self.assertGreater(figures["new_goals_scheduled"], 11)

    def test_wrong_options_are_told(self) -> None:
        for options in (("--runs", "0"), ("--most", "11"), ("--cap", "-1"), ("--quickly",)):
            wrong = self.bench(*options)
            self.assertEqual(wrong.returncode, 2, options)


if __name__ == "__main__":
    unittest.main()
