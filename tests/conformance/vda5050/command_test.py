#!/usr/bin/env python3
"""`stepwright vda5050 check`: what it prints and how it ends.

usage: command_test.py STEPWRIGHT_VDA5050
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
CONNECTION = {"headerId": 1, "timestamp": "2026-11-23T03:50:00.125Z", "version": "2.1.0", "manufacturer": "Stepwright",
              "serialNumber": "v1", "connectionState": "ONLINE"}


class Check(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check(self, topic, *texts):
        files = []
        for number, text in enumerate(texts):
            files.append(self.folder / f"{number}.json")
            files[-1].write_text(text, encoding="utf-8")
        return subprocess.run([PROGRAM, "check", topic, *files], capture_output=True, text=True, check=False)

    def test_Check_WhenAllIsWell_ThenNothingAndZero(self):
        done = self.check("connection", json.dumps(CONNECTION), json.dumps({**CONNECTION, "connectionState": "OFFLINE"}))
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_Check_WhenAMessageIsWrong_ThenFilePointerAndHint(self):
        done = self.check("connection", json.dumps(CONNECTION), json.dumps({**CONNECTION, "connectionState": "ONLIN"}))
        self.assertEqual(done.returncode, 1)
        self.assertIn("1.json: F0903: /connectionState: 'ONLIN' is none of", done.stderr)
        self.assertIn("did you mean 'ONLINE'?", done.stderr)

    def test_Check_WhenTheFileIsMissingOrTheTopicUnknown_ThenSaid(self):
        missing = subprocess.run([PROGRAM, "check", "state", self.folder / "none.json"], capture_output=True, text=True, check=False)
        self.assertEqual(missing.returncode, 1)
        self.assertIn("E0001", missing.stderr)
        self.assertEqual(self.check("orders", "{}").returncode, 2)


if __name__ == "__main__":
    unittest.main()
