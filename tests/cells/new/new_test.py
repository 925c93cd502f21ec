"""`stepwright new`: each kind of cell is sound, passes its tests and runs as it is; nothing is ever overwritten."""

import json
import pathlib
import re
import tempfile
import unittest

from namespaces import need_network_of_its_own
from processes import eventually, get, stepwright

COMMON = {"README.md", "alarms.toml", "cell.toml", "main.st", "recipes.toml"}


class New(unittest.TestCase):
    def setUp(self):
        need_network_of_its_own()  # pages and devices have ports that others may have, too
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)

    def new(self, name, *arguments):
        return stepwright("new", name, *arguments, cwd=self.root)

    def up(self, folder, *arguments):
        done = stepwright("up", *arguments, "--detach", cwd=folder)
        self.addCleanup(stepwright, "down", *(each for each in arguments if str(each).endswith(".toml")), cwd=folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def runs(self, folder):
        """The program of the cell runs."""
        return eventually(lambda: 'state="running"} 1' in stepwright("metrics", "--config", "cell.toml", cwd=folder).stdout)

    def look_at(self, plant, files=COMMON):
        made = self.new("line", "--plant", plant)
        self.assertEqual(made.returncode, 0, made.stderr)
        folder = self.root / "line"
        self.assertEqual({path.name for path in folder.iterdir()}, set(files))
        for path in folder.iterdir():
            self.assertNotIn("{{", path.read_text(encoding="utf-8"), path)
        checked = stepwright("check", cwd=folder)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""))
        tested = stepwright("test", cwd=folder)
        self.assertEqual(tested.returncode, 0, tested.stdout + tested.stderr)
        self.assertRegex(tested.stdout, r"(?m)^[1-9]\d* tests?: [1-9]\d* ok, 0 failed")
        return folder

    def value(self, folder, name):
        """A number of the running program; none as long as it is not known."""
        found = re.search(rf"{re.escape(name)} = (-?\d+)", stepwright("snapshot", "--config", "cell.toml", name, cwd=folder).stdout)
        return int(found.group(1)) if found else None

    def page_of(self, folder):
        status = json.loads(stepwright("status", "--json", cwd=folder).stdout)
        self.assertTrue(status["ready"])
        port = int(re.search(r":(\d+)/", status["address"]).group(1))
        tags = lambda: json.loads(get(port, "/api/recipe-tags")[1])["tags"]
        self.assertTrue(eventually(lambda: all("value" in each for each in tags())), tags())
        figures = lambda: json.loads(get(port, "/api/alarms")[1])["figures"]
        self.assertTrue(eventually(lambda: figures()["no_value"] + figures()["no_variable"] == 0), figures())

    def test_a_cell_without_a_plant(self):
        folder = self.look_at("none")
        self.up(folder, "--port", 0)
        self.assertTrue(self.runs(folder))
        self.page_of(folder)

    def test_a_cell_with_tanks(self):
        folder = self.look_at("tanks")
        self.up(folder, "--port", 0, "--set", "clock.speed=10")
        self.assertTrue(self.runs(folder))
        self.page_of(folder)
        self.assertTrue(eventually(lambda: self.value(folder, "Main.trips")), "the vehicle makes its trips")

    def test_a_cell_with_a_conveyor(self):
        folder = self.look_at("conveyor")
        self.up(folder, "--port", 0, "--set", "clock.speed=10")
        self.assertTrue(self.runs(folder))
        self.page_of(folder)
        self.assertTrue(eventually(lambda: self.value(folder, "Main.count_1")), "boxes get into the chute")

    def test_a_cell_with_devices_over_modbus(self):
        folder = self.look_at("modbus", COMMON | {"device.st", "device.toml"})
        checked = stepwright("check", "device.toml", cwd=folder)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""))
        self.up(folder, "device.toml")
        self.up(folder)
        self.assertTrue(self.runs(folder))
        self.assertTrue(eventually(lambda: 300 < (self.value(folder, "Main.level_raw") or 0) < 700), "the level of the device")
        self.page_of(folder)

    def test_what_is_there_is_not_touched(self):
        folder = self.root / "line"
        folder.mkdir()
        self.assertEqual(self.new("line").returncode, 0, "an empty folder is filled")
        (folder / "main.st").write_text("mine", encoding="utf-8")
        before = {path.name: path.read_bytes() for path in folder.iterdir()}
        again = self.new("line", "--plant", "tanks")
        self.assertEqual(again.returncode, 1)
        self.assertIn("line: M0019: this is there already", again.stderr)
        self.assertEqual({path.name: path.read_bytes() for path in folder.iterdir()}, before)
        (self.root / "file").write_text("mine", encoding="utf-8")
        self.assertEqual(self.new("file").returncode, 1)
        self.assertEqual({path.name for path in self.root.iterdir()}, {"line", "file"})

    def test_what_cannot_name_a_cell_is_refused(self):
        for name in ("a b", "-x", "x" * 60, "ä"):
            done = self.new("--", name) if name.startswith("-") else self.new(name)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("M0018", done.stderr)
        self.assertEqual(self.new("line", "--plant", "tank").returncode, 2)
        self.assertEqual(list(self.root.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
