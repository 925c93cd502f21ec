"""The main job recorded by the runtime process and replayed without a plant on both engines."""

import json
import pathlib
import tempfile
import unittest

from cell_process import Demo, stepwright


class Recording(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(self.folder.cleanup)
        self.recording = pathlib.Path(self.folder.name) / "job.swrec"

    def record(self, *arguments):
        """Runs the demo with a recording; its report and exit code."""
        with Demo("--fast", "--no-compare", "--set", f"record.file={self.recording}", *arguments) as demo:
            return demo.result()

    def replay(self, *arguments):
        report = pathlib.Path(self.folder.name) / "replay.json"
        result = stepwright("replay", self.recording, "--json", report, *arguments)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return json.loads(report.read_text(encoding="utf-8"))["engines"]

    def test_both_engines_replay_the_main_job(self):
        with Demo("--fast", "--no-compare") as demo:
            plain, _ = demo.result()
        recorded, code = self.record()
        self.assertEqual(code, 0, recorded["stdout"])
        self.assertEqual(recorded["trace_hash"], plain["trace_hash"])
        engines = self.replay()
        self.assertEqual([engine["engine"] for engine in engines], ["vm", "native"])
        for engine in engines:
            self.assertTrue(engine["equal"])
            self.assertTrue(engine["ended"])
            self.assertEqual(engine["problems"], [])
            self.assertEqual(engine["scans"], recorded["scans"])
            self.assertEqual(engine["trace_hash"], recorded["trace_hash"])
            self.assertGreater(engine["realtime_factor"], 1)

    def test_a_job_that_was_replanned_is_replayed_with_all_its_programs(self):
        recorded, _ = self.record("--fault", "leak_a1=0.3@40")
        self.assertGreaterEqual(recorded["replans"], 1)
        for engine in self.replay():
            self.assertEqual(engine["trace_hash"], recorded["trace_hash"])
            self.assertGreaterEqual(engine["programs"], 2)

    def test_a_table_of_the_job_has_every_scan(self):
        recorded, _ = self.record()
        table = pathlib.Path(self.folder.name) / "job.csv"
        self.replay("--engine", "native", "--trace", "%QX0.0,%IW1", "--csv", table)
        lines = table.read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[0], "scan,time_s,%QX0.0,%IW1")
        self.assertEqual([int(line.split(",")[0]) for line in lines[1:]], list(range(1, recorded["scans"] + 1)))


if __name__ == "__main__":
    unittest.main()
