#!/usr/bin/env python3
"""bench_campaign as a user runs it: the keys of its report, wrong options, an interruption."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

CAMPAIGN = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"]) / "bench_campaign"


class BenchCampaign(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.report = self.folder / "report.json"

    def campaign(self, *options: str) -> subprocess.CompletedProcess:
        return subprocess.run([CAMPAIGN, *options], capture_output=True, text=True, check=False)

    def figures(self) -> dict:
        return json.loads(self.report.read_text(encoding="utf-8"))

    def test_the_promised_keys(self) -> None:
        done = self.campaign("--runs", "3", "--first", "5", "--json", str(self.report))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        figures = self.figures()
        self.assertEqual((figures["runs"], figures["first_seed"], figures["lost"]), (3, 5, 0))
        self.assertEqual(figures["goals_reached"] + figures["safe_stops"], 3)

    def test_the_other_cells_have_their_own_figures(self) -> None:
        done = self.campaign("--cell", "fleet", "--runs", "1", "--first", "2", "--json", str(self.report))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        figures = self.figures()
        self.assertEqual((figures["cell"], figures["runs"], figures["lost"]), ("fleet", 1, 0))
        self.assertEqual([each["class"] for each in figures["classes"]], ["death"])

    def test_wrong_options_are_told_before_any_run(self) -> None:
        for options in (("--runs", "-1"), ("--runs", "0"), ("--runs", ""), ("--runs", "ten"), ("--threads", "0"),
                        ("--first", "-5"), ("--json",), ("--runs",), ("--quickly",), ("3",)):
            wrong = self.campaign(*options)
            self.assertEqual(wrong.returncode, 2, options)
            self.assertEqual(wrong.stdout, "", options)
        for file in ("/nonexistent/report.json", str(self.folder)):
            unwritable = self.campaign("--json", file)
            self.assertEqual(unwritable.returncode, 1)
            self.assertIn(f"{file}: E0002", unwritable.stderr)
            self.assertEqual(unwritable.stdout, "")

    def test_an_interruption_leaves_the_runs_that_were_done(self) -> None:
        command = [CAMPAIGN, "--runs", "1000000", "--threads", "1", "--json", self.report]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            process.stderr.read(1)  # the first run is done
            process.send_signal(signal.SIGINT)
            stdout, stderr = process.communicate()
        self.assertEqual(process.returncode, 4, stderr)
        self.assertIn(b"interrupted", stderr)
        self.assertIn(b"all ", stdout)
        self.assertGreaterEqual(self.figures()["runs"], 1)
        self.assertLess(self.figures()["runs"], 1000000)


if __name__ == "__main__":
    unittest.main()
