#!/usr/bin/env python3
"""bench_allocation as a user runs it, on few and small instances: the keys of its report, no fault, wrong options."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BENCH = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"]) / "bench_allocation"


class BenchAllocation(unittest.TestCase):
    def bench(self, *options: str) -> subprocess.CompletedProcess:
        return subprocess.run([BENCH, *options], capture_output=True, text=True, check=False)

    def test_rules_of_thumb_are_no_better(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            report = pathlib.Path(name) / "report.json"
            done = self.bench("--most", "10", "--seeds", "1", "--rounds", "300", "--exact", "1", "--json", str(report))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            figures = json.loads(report.read_text(encoding="utf-8"))
        self.assertEqual(figures["checker_faults"], 0)
        self.assertEqual([row["proved"] for row in figures["exact"]], [1, 1, 1, 1])
        self.assertEqual(len(figures["rows"]), 4)
        for row in figures["rows"]:
            self.assertEqual(row["found"], 1, row)
            self.assertGreaterEqual(row["ratio_to_bound"], 1.0, row)
            for rule in ("nearest", "insertion"):
                self.assertTrue(row[f"{rule}_found"] == 0 or row[f"ratio_{rule}"] >= 1.0, row)
        self.assertGreater(figures["ratio_nearest"], 1.0)
        self.assertGreater(figures["ratio_insertion"], 1.0)

    def test_wrong_options_are_told(self) -> None:
        for options in (("--most", "5"), ("--rounds", "0"), ("--seeds", "-1"), ("--quickly",)):
            wrong = self.bench(*options)
            self.assertEqual(wrong.returncode, 2, options)


if __name__ == "__main__":
    unittest.main()
