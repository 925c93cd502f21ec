#!/usr/bin/env python3
"""bench_historian as a user runs it, with few samples: the keys of its report, sizes, wrong options. No times."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BENCH = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"]) / "bench_historian"


class BenchHistorian(unittest.TestCase):
    def bench(self, *options: str) -> subprocess.CompletedProcess:
        return subprocess.run([BENCH, *options], capture_output=True, text=True, check=False)

    def test_samples_are_small_and_trends_are_those_of_the_rows(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            report = pathlib.Path(name) / "report.json"
            done = self.bench("--samples", "100000", "--tags", "10", "--days", "1", "--columns", "200", "--changes", "2000",
                              "--alarm-seconds", "0.2", "--json", str(report))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            figures = json.loads(report.read_text(encoding="utf-8"))
        self.assertEqual(figures["samples"], 100000)
        self.assertEqual(figures["trend_samples"], 86400)
        self.assertLessEqual(figures["bytes_per_sample"], 3.0)
        self.assertLess(figures["bytes_per_sample"] * 4, figures["sqlite_rows_bytes_per_sample"])
        self.assertEqual(figures["alarm_changes_lost"], 0)
        for key in ("historian_samples_per_s", "csv_samples_per_s", "sqlite_rows_samples_per_s", "trend_query_ms", "alarm_changes_per_s"):
            self.assertGreater(figures[key], 0.0)

    def test_wrong_options_are_told(self) -> None:
        for options in (("--samples", "1"), ("--folder", "/none"), ("--quickly",)):
            self.assertEqual(self.bench(*options).returncode, 2, options)


if __name__ == "__main__":
    unittest.main()
