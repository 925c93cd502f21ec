"""doc/reference: what is made of the programs is what they say now; a key that nobody knows is told with the nearest one."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from processes import SOURCES, STEPWRIGHT, stepwright


class Reference(unittest.TestCase):
    def test_the_documents_are_those_of_the_programs(self):
        done = subprocess.run([sys.executable, SOURCES / "scripts/reference", "--check"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_reference_is_data_too(self):
        tables = {each["name"]: each for each in json.loads(stepwright("reference", "--json").stdout)["tables"]}
        port = next(each for each in tables["hmi"]["keys"] if each["key"] == "port")
        self.assertEqual((port["default"], port["range"]), ("`8080`", "0 to 65535"))
        self.assertTrue(tables["modbus.device.group"]["array"])

    def test_files_that_a_cell_names_have_theirs(self):
        for name, table in (("alarms", "alarm"), ("recipes", "tag"), ("binding", "actions"), ("plant", "components.NAME")):
            with self.subTest(file=name):
                tables = {each["name"] for each in json.loads(stepwright("reference", name, "--json").stdout)["tables"]}
                self.assertIn(table, tables)
        self.assertEqual(stepwright("reference", "nosuch").returncode, 2)

    def test_a_full_disk_is_told(self):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([STEPWRIGHT, "reference"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("E0002: the file cannot be written: No space left on device", done.stderr)

    def test_check_names_the_nearest_key_or_the_table_that_has_it(self):
        with tempfile.TemporaryDirectory(prefix="stepwright-test-") as folder:
            cell = pathlib.Path(folder) / "cell.toml"
            cell.write_text('[runtime]\ninterval_us = 5000\n[hmi]\nprot = 8081\n[plant]\nkind = "none"\nmap = "map.yaml"\n', encoding="utf-8")
            said = stepwright("check", cell)
            self.assertEqual(said.returncode, 1)
            self.assertIn("cell.toml:2:1: C0002: unknown key 'runtime.interval_us'", said.stderr)
            self.assertIn("'interval_us' is a key of [clock]", said.stderr)
            self.assertIn("did you mean 'port'?", said.stderr)
            self.assertIn("[plant] has this key, but not with what else it says here", said.stderr)


if __name__ == "__main__":
    unittest.main()
