#!/usr/bin/env python3
"""bench_hmi as a user runs it, with few changes and tags: the keys of its report, wrong options. No times."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BENCH = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"]) / "bench_hmi"


class BenchHmi(unittest.TestCase):
    def bench(self, *options: str) -> subprocess.CompletedProcess:
        return subprocess.run([BENCH, *options], capture_output=True, text=True, check=False)

    def test_every_change_is_painted_and_all_figures_are_there(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            report = pathlib.Path(name) / "report.json"
            done = self.bench("--clients", "5", "--changes", "10", "--tags", "300", "--seconds", "1", "--no-historian", "--json", str(report))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            figures = json.loads(report.read_text(encoding="utf-8"))
        for key in ("pixel_p50_ms", "pixel_p99_ms", "polling_p50_ms", "pushed_p50_ms", "core_share_5000_tags", "core_share_all_clients", "screen_500_symbols_fps",
                    "screen_500_symbols_update_ms", "bare_to_page_s", "up_to_page_s"):
            self.assertGreater(figures[key], 0.0, key)
        self.assertGreaterEqual(figures["pixel_p99_ms"], figures["pixel_p50_ms"])
        self.assertLess(figures["first_load_kb"], 150.0)

    def test_wrong_options_are_told(self) -> None:
        for options in (("--clients", "0"), ("--changes", "many"), ("--quickly",)):
            done = self.bench(*options)
            self.assertEqual(done.returncode, 2, options)
            self.assertIn("usage:", done.stderr)


if __name__ == "__main__":
    unittest.main()
