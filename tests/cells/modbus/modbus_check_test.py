"""`stepwright check` and the parts of a cell that speak Modbus: what the processes refuse, and what does not fit the program."""

import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from processes import Cell, stepwright

PROGRAM = """\
PROGRAM Main
  VAR
    level AT %IW0 : INT;
    flow AT %ID1 : REAL;
    raw AT %IW4 : UINT;
    flags AT %IW5 : WORD;
    set AT %QW0 : INT;
    levels : ARRAY[0..9] OF REAL;
    name : STRING;
  END_VAR
  VAR CONSTANT limit : INT := 7; END_VAR
  set := level;
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Cpu ON Any
    TASK Fast(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH Fast : Main;
  END_RESOURCE
END_CONFIGURATION
"""
SERVER = """\
[plant]
kind = "none"
[runtime]
program = "main.swb"
[modbus.server]
enabled = true
"""
CLIENT = """\
[clock]
mode = "real"
[io]
kind = "modbus"
[runtime]
program = "main.swb"
[[modbus.device]]
name = "press"
host = "10.0.0.7"
[[modbus.device.group]]
tags = [
%s
]
"""


class ModbusCheck(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.file = self.folder / "cell.toml"
        self.compile(PROGRAM)

    def compile(self, text):
        (self.folder / "main.st").write_text(text, encoding="utf-8")
        done = stepwright("compile", self.folder / "main.st", "-o", self.folder / "main.swb")
        self.assertEqual(done.returncode, 0, done.stderr)

    def check(self, text, *options):
        """The exit code, "line code" of each diagnostic, and all of them."""
        self.file.write_text(text, encoding="utf-8")
        report = self.folder / "check.json"
        done = stepwright("check", "--config", self.file, "--json", report, *options)
        found = json.loads(report.read_text(encoding="utf-8"))["diagnostics"]
        return done, found

    def expect(self, text, code, severity="error", *options):
        """One mistake: at the place that `@` marks in the text."""
        at = text.index("@")
        line, column = text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)
        done, found = self.check(text.replace("@", ""), *options)
        self.assertEqual([(each["line"], each["column"], each["code"], each["severity"]) for each in found],
                         [(line, column, code, severity)], done.stderr)
        self.assertEqual(done.returncode, 1 if severity == "error" else 0, done.stdout + done.stderr)
        return done.stderr

    def range(self, text):
        return SERVER + "[[modbus.server.range]]\n" + text

    def test_a_range_is_held_against_the_program_at_the_key_that_is_wrong(self):
        good = self.range('first = 5000\nvariable = "Main.levels"\nwritable = true\n')
        done, found = self.check(good)
        self.assertEqual((done.returncode, found), (0, []), done.stderr)
        self.expect(self.range('first = 3\nvariable = @"Main.levles"\n'), "C0501")
        self.expect(self.range('address = @"%MW900"\n'), "C0501")
        self.expect(self.range('variable = "Main.levels"\ncount = @11\n'), "C0502")
        self.expect(self.range('variable = "Main.levels"\nfirst = @65530\n'), "C0502")
        self.expect(self.range('variable = "Main.limit"\nwritable = @true\n'), "C0504")
        self.expect(self.range('variable = "Main.level"\nwritable = @true\n'), "C0504")
        self.expect(self.range('variable = @"Main.name"\n'), "C0505")
        self.expect(self.range('variable = "Main.set"\n[[modbus.server.range]]\nfirst = @0\nvariable = "Main.level"\n'),
                    "C0503")

    def test_it_says_what_registers_says(self):
        text = self.range('first = 3\nvariable = "Main.levles"\n[[modbus.server.range]]\nvariable = "Main.name"\n')
        checked, _ = self.check(text)
        told = stepwright("registers", self.folder / "main.swb", "--config", self.file)
        self.assertEqual(told.returncode, 1)
        self.assertEqual(sorted(told.stderr.splitlines()), sorted(checked.stderr.splitlines()))
        self.assertIn("did you mean", told.stderr)

    def test_the_program_is_the_one_that_is_named_or_the_one_that_a_start_loads(self):
        text = self.range('variable = "Main.levels"\n')
        other = self.folder / "other"
        other.mkdir()
        (other / "other.st").write_text("PROGRAM Main VAR x : INT; END_VAR x := 1; END_PROGRAM", encoding="utf-8")
        done = stepwright("compile", other / "other.st", "-o", other / "other.swb")
        self.assertEqual(done.returncode, 0, done.stderr)
        done, found = self.check(text, "--program", other / "other.swb")
        self.assertEqual([each["code"] for each in found], ["C0501"], done.stderr)
        nameless = text.replace('[runtime]\nprogram = "main.swb"\n', "")
        done, found = self.check(nameless)
        self.assertEqual([(each["code"], each["severity"]) for each in found], [("C0530", "note")])
        self.assertEqual(done.returncode, 0)
        done, found = self.check(nameless, "--program", self.folder / "main.swb")
        self.assertEqual((done.returncode, found), (0, []), done.stderr)

    def test_what_a_load_refuses_is_refused(self):
        done, found = self.check(SERVER + "[image]\ninput_bytes = 8\n")
        self.assertEqual([each["code"] for each in found], ["R0080"], done.stderr)
        self.assertIn("main.swb", found[0]["file"])
        (self.folder / "main.swb").write_bytes(b"no container")
        done, found = self.check(SERVER)
        self.assertEqual([each["code"][0] for each in found], ["B"], done.stderr)
        (self.folder / "main.swb").unlink()
        done, found = self.check(SERVER)
        self.assertEqual(([each["code"] for each in found], done.returncode), (["R0026"], 1))

    def test_the_text_is_that_of_the_load(self):
        done, _ = self.check(SERVER + "[image]\ninput_bytes = 8\n")
        message = re.search(r"R0080: (.*)", done.stderr).group(1)
        cell = Cell('[plant]\nkind = "none"\n[image]\ninput_bytes = 8\n')
        self.addCleanup(cell.__exit__)
        cell.start_runtime()
        loaded = stepwright("download", "--config", cell.config, self.folder / "main.swb", "--replace")
        self.assertEqual(loaded.returncode, 1)
        self.assertIn(message, loaded.stderr)

    def test_tags_are_held_against_the_variables_of_the_program(self):
        def tag(text):
            return CLIENT % text

        good = ('{ address = "%IW0", holding = 0 },\n{ address = "%ID1", holding = 2, type = "real" },\n'
                '{ address = "%IW4", holding = 4 },\n{ address = "%IW5", holding = 5, type = "uint16" },\n'
                '{ address = "%QW0", holding = 9 },')
        done, found = self.check(tag(good))
        self.assertEqual((done.returncode, found), (0, []), done.stderr)
        said = self.expect(tag('{ address = @"%ID1", holding = 2 },'), "C0528")
        self.assertIn("Main.flow", said)
        self.assertIn('iec = "REAL"', said)
        self.expect(tag('{ address = @"%IW0", holding = 2, type = "int32", iec = "UINT", factor = 0.1 },'), "C0528", "warning")
        self.expect(tag('{ address = @"%IW0", holding = 2, iec = "UINT" },'), "C0528", "warning")
        self.expect(tag('{ address = @"%IW20", holding = 2 },'), "C0529", "warning")
        self.expect(tag('{ address = @"%QW9", holding = 2 },'), "C0529", "warning")
        # What needs no program stays as it is.
        self.expect(tag('{ address = @"%IW900", holding = 2 },'), "C0303")

    def test_a_client_that_is_lost_before_it_can_say_that_it_lives_is_refused(self):
        good = CLIENT % '{ address = "%IW0", holding = 0 },'
        for times in ("silence_ms = @20\ncycle_ms = 1000", "cycle_ms = @250", "cycle_ms = 100\nsilence_ms = @100"):
            self.expect(good + f"[modbus.client]\n{times}\n", "C0526")
        done, found = self.check(good + "[modbus.client]\ncycle_ms = 100\n")
        self.assertEqual((done.returncode, found), (0, []), done.stderr)

    def test_certificates_are_read(self):
        tls = ('[modbus.server.tls]\ncertificate = "a.crt"\nkey = "a.key"\nauthorities = "a.crt"\n')
        make = ("openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 3 -subj /CN=%s "
                "-keyout %s.key -out %s.crt && chmod 600 %s.key")
        for name in "ab":
            subprocess.run(["sh", "-ec", make % ((name,) * 4)], cwd=self.folder, check=True, capture_output=True)
        done, found = self.check(SERVER + tls)
        self.assertEqual((done.returncode, found), (0, []), done.stderr)
        done, found = self.check(SERVER + tls.replace("a.key", "b.key"))
        self.assertEqual([(each["code"], each["line"]) for each in found], [("R0115", 7)], done.stderr)
        cell_text = SERVER.replace('[runtime]\nprogram = "main.swb"\n', "")
        cell = Cell(cell_text + "port = 0\n" + tls.replace("a.key", "b.key").replace('"a.', f'"{self.folder}/a.').replace(
            '"b.', f'"{self.folder}/b.') + "port = 0\n")
        self.addCleanup(cell.__exit__)
        server = cell.start("modbus-server")
        self.assertEqual(server.wait(), 1)
        self.assertIn("R0115: " + found[0]["message"], server.output())
        (self.folder / "a.key").chmod(0o644)
        done, found = self.check(SERVER + tls)
        self.assertEqual([each["code"] for each in found], ["R0116"], done.stderr)

    def test_what_the_gateway_refuses(self):
        gateway = ('[plant]\nkind = "none"\n[controller]\nkind = "modbus-tcp"\nhost = "127.0.0.1"\n'
                   'program = "loaded-by-hand"\nplan = "table.json"\n')
        table = self.folder / "table.json"
        for content in (None, '{"actions": 3}', '{"registers": 1, "actions": [{"number": "1", "after": []}]}'):
            if content:
                table.write_text(content, encoding="utf-8")
            done, found = self.check(gateway)
            self.assertEqual([each["code"] for each in found], ["C0566"], done.stderr)
            refused = stepwright("gateway", "--config", self.file)
            self.assertEqual(refused.returncode, 1)
            self.assertEqual(refused.stderr.strip(), done.stderr.strip())
        table.write_text('{"registers": 1, "actions": [{"number": 1, "after": []}]}', encoding="utf-8")
        done, found = self.check(gateway)
        self.assertEqual((done.returncode, found), (0, []), done.stderr)

    def test_a_line_that_nobody_has_is_refused_at_its_place(self):
        text = '[plant]\nkind = "none"\n[controller]\nkind = "modbus-rtu"\ndevice = "/dev/ttyS9"\nbaud = 12345\n'
        done, found = self.check(text)
        self.assertEqual([(each["code"], each["line"]) for each in found], [("R0126", 3)], done.stderr)
        refused = stepwright("gateway", "--config", self.file)
        self.assertEqual(refused.returncode, 1)
        self.assertEqual(refused.stderr.strip(), done.stderr.strip())

    def test_a_program_is_held_against_what_a_turn_over_modbus_carries(self):
        self.compile(PROGRAM.replace("set AT %QW0", "set AT %QW900"))
        remote = '[plant]\nkind = "none"\n[controller]\nkind = "modbus-tcp"\nhost = "127.0.0.1"\n[image]\n'
        done, found = self.check(remote + "output_bytes = 4000\n", "--program", self.folder / "main.swb")
        self.assertEqual([each["code"] for each in found], ["R0145"], done.stderr)
        self.assertIn("one turn over Modbus", found[0]["message"])
        self.assertIn("main.swb", found[0]["file"])
        self.compile(PROGRAM)
        done, found = self.check(remote + "input_bytes = 4\n", "--program", self.folder / "main.swb")
        self.assertEqual([each["code"] for each in found], ["R0145"], done.stderr)
        self.assertIn("than the cell", found[0]["message"])


if __name__ == "__main__":
    unittest.main()
