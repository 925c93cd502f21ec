"""`stepwright check`: every problem of a configuration in one run, each with its place, for people and for machines."""

import json
import pathlib
import re
import tempfile
import unittest

from processes import SOURCES, stepwright

# One mistake per line that carries a code; `at` is where it must be reported.
MISTAKES = """\
[cell]
name = "bad name"                 # at 2:8 C0461
[clock]
mode = "reel"                     # at 4:8 C0006 real
speed = -1                        # at 5:9 C0004
interval_us = "fast"              # at 6:15 C0003
[plant.ports]
fc9 = "%IX0.0"                    # at 8:7 C0301
fc1 = "%IX64.0"                   # at 9:7 C0303
[safe_state.outputs]
"%QX64.0" = "one"                 # at 11:13 C0303
"Q0" = "one"                      # at 12:8 C0302
[[faults]]
at_s = 1.0
name = "leek_a1"                  # at 15:8 C0311 leak_a1
value = 1.0
[log]
levl = "debug"                    # at 18:1 C0002 level
[dds]
interfaces = ["eth0"]             # at 20:14 C0466
[planning]
domain = "gone.pddl"              # at 22:10 C0006
problem = "gone.pddl"             # at 23:11 C0006
binding = "gone.toml"             # at 24:11 C0006
[typo]                            # at 25:2 C0002
"""


class Check(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.folder = pathlib.Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)
        self.file = self.folder / "cell.toml"
        self.json = self.folder / "check.json"

    def check(self, text, *options):
        self.file.write_text(text, encoding="utf-8")
        return stepwright("check", "--config", self.file, "--json", self.json, *options)

    def test_every_mistake_is_found_in_one_run_at_its_place(self):
        result = self.check(MISTAKES)
        self.assertEqual(result.returncode, 1)
        expected = [re.search(r"# at (\d+):(\d+) (C\d+) ?(\w*)", line) for line in MISTAKES.splitlines()]
        expected = [match.groups() for match in expected if match]
        report = json.loads(self.json.read_text(encoding="utf-8"))
        self.assertFalse(report["sound"])
        found = {(each["line"], each["column"], each["code"]): each for each in report["diagnostics"]}
        for line, column, code, meant in expected:
            key = (int(line), int(column), code)
            self.assertIn(key, found, result.stderr)
            self.assertIn(meant, found[key]["hint"])
            self.assertIn(f"cell.toml:{line}:{column}: {code}: ", result.stderr)
        self.assertEqual(len(found), len(expected), result.stderr)

    def test_a_cell_without_planning_is_sound(self):
        result = self.check('[cell]\nname = "line"\n[plant]\nkind = "none"\n')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("sound", result.stdout)
        self.assertNotIn("plan", result.stdout)
        self.assertTrue(json.loads(self.json.read_text(encoding="utf-8"))["sound"])

    def test_the_bench_is_sound_and_its_plan_is_told(self):
        result = stepwright("check", "--config", SOURCES / "tests/cells/bench/cell.toml", "--json", self.json)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(self.json.read_text(encoding="utf-8"))["plan_steps"], 17)

    def test_a_wrong_override_is_named(self):
        result = self.check('[plant]\nkind = "none"\n', "--set", "plant.seed=-4")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--set plant.seed=-4: C0004", result.stderr)

    def test_a_file_that_is_no_toml_or_is_not_there(self):
        result = self.check("[cell\n")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"cell\.toml:\d+:\d+: C0001")
        self.file.unlink()
        result = stepwright("check", "--config", self.file)
        self.assertEqual(result.returncode, 1)
        self.assertIn("M0012: there is no such cell", result.stderr)
        self.assertIn("stepwright new", result.stderr)

    def test_what_is_said_of_a_tag_that_the_program_lacks_is_a_warning(self):
        source = self.folder / "line.st"
        source.write_text("PROGRAM Main\n  VAR level : REAL; table : ARRAY[1..3] OF INT; END_VAR\n  level := 1.0;\nEND_PROGRAM\n", encoding="utf-8")
        self.assertEqual(stepwright("compile", source, "-o", self.folder / "line.swb").returncode, 0)
        self.check('[cell]\nname = "line"\n[plant]\nkind = "none"\n[tags."main.LEVEL"]\nunit = "l"\n[tags."Main.table"]\nunit = "m"\n'
                   '[tags."Main.levle"]\nunit = "l"\n', "--program", self.folder / "line.swb")
        found = [each for each in json.loads(self.json.read_text(encoding="utf-8"))["diagnostics"] if each["code"] == "C0632"]
        self.assertEqual([(each["line"], each["severity"], each["hint"]) for each in found], [(9, "warning", "did you mean 'Main.level'?")])

    def test_what_is_kept_of_a_variable_that_the_program_lacks_is_a_warning(self):
        source = self.folder / "line.st"
        source.write_text("PROGRAM Main\n  VAR level : REAL; END_VAR\n  level := 1.0;\nEND_PROGRAM\n", encoding="utf-8")
        self.assertEqual(stepwright("compile", source, "-o", self.folder / "line.swb").returncode, 0)
        (self.folder / "access").mkdir()
        (self.folder / "access" / "forces.json").write_text('{"forces": [{"name": "Main.leve"}, {"name": "MAIN.LEVEL"}]}', encoding="utf-8")
        (self.folder / "access" / "trends.json").write_text(
            '{"groups": [{"name": "tank", "series": [{"tag": "points/gone"}, {"tag": "Main.level"}]}]}', encoding="utf-8")
        result = self.check('[cell]\nname = "line"\n[plant]\nkind = "none"\n[hmi]\naccess_dir = "access"\n', "--program", self.folder / "line.swb")
        self.assertEqual(result.returncode, 0, result.stderr)
        found = [each for each in json.loads(self.json.read_text(encoding="utf-8"))["diagnostics"] if each["code"] == "C0634"]
        self.assertEqual(sorted(each["message"] for each in found),
                         ["a force names 'Main.leve', which the program does not have", "the trend 'tank' names 'gone', which the program does not have"])
        self.assertIn("did you mean 'Main.level'?", [each["hint"] for each in found])

    def test_a_table_of_tags_stands_beside_the_cell(self):
        (self.folder / "tags.csv").write_text("name,unit,least,greatest\nMain.level,l,0,\n", encoding="utf-8")
        result = self.check('[cell]\nname = "line"\n[plant]\nkind = "none"\n[hmi]\ntags = "tags.csv"\n')
        self.assertEqual(result.returncode, 1)
        self.assertIn("tags.csv:2:14: C0631", result.stderr)

    def test_an_alarm_that_is_called_as_a_built_in_one_is_found(self):
        (self.folder / "alarms.toml").write_text('[[alarm]]\nname = "runtime.lost"\nsource = "Main.x"\nwhen = "on"\n', encoding="utf-8")
        result = self.check('[cell]\nname = "line"\n[plant]\nkind = "none"\n[history]\nfolder = "h"\nalarms = "alarms.toml"\n')
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"alarms\.toml:1:\d+: C0601: there are two alarms runtime\.lost")
        self.assertIn("built in", result.stderr)

    def test_addresses_that_this_machine_lacks_are_told(self):
        # Of the blocks that are kept for documents (RFC 5737, RFC 3849).
        result = self.check(
            '[cell]\nname = "line"\n[plant]\nkind = "none"\n[modbus.server]\nenabled = true\nbind = "2001:db8::1"\n[dds]\ninterfaces = ["127.0.0.1", "192.0.2.1"]\n')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("cell.toml:7:8: warning: C0474: no interface of this machine has the address 2001:db8::1", result.stderr)
        self.assertRegex(result.stderr, r"cell\.toml:9:14: warning: C0474: .*192\.0\.2\.1.*\n.*127\.0\.0\.1")
        self.assertRegex(result.stdout, r"2 warnings")

    def test_two_servers_on_one_port_are_found(self):
        cell = '[cell]\nname = "line"\n[plant]\nkind = "none"\n[hmi]\nport = 8502\n[modbus.server]\nenabled = true\nport = {}\n[modbus.server.metrics]\nport = {}\n'
        result = self.check(cell.format(8502, 9502))
        self.assertEqual(result.returncode, 1)
        self.assertIn("cell.toml:9:8: C0473: port 8502 is that of [hmi], too", result.stderr)
        result = self.check(cell.format(8503, 8503))
        self.assertIn("cell.toml:11:8: C0473: port 8503 is that of [modbus.server], too", result.stderr)
        self.assertEqual(self.check(cell.format(0, 0)).returncode, 0)
        self.assertEqual(self.check(cell.format(8503, 9502)).returncode, 0)

    def test_a_retain_file_of_somebody_else_is_found(self):
        (self.folder / "notes.txt").write_text("of somebody\n", encoding="utf-8")
        (self.folder / "mine").mkdir()
        for name, what in (("notes.txt", "this file is no store"), ("mine", "this is a folder")):
            result = self.check(f'[cell]\nname = "line"\nstate_dir = "."\n[plant]\nkind = "none"\n[retain]\nfile = "{name}"\n')
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, rf"cell\.toml:7:8: R0024: .*{what}.*: it is neither replaced nor moved")
        self.assertEqual((self.folder / "notes.txt").read_text(encoding="utf-8"), "of somebody\n")

    def test_checking_leaves_nothing_behind(self):
        self.check('[cell]\nname = "line"\nstate_dir = "state"\n')
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["cell.toml", "check.json"])


if __name__ == "__main__":
    unittest.main()
