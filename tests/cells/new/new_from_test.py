"""`stepwright new --from`: a PLCopen project becomes a cell that runs; what it could not take is said."""

import json
import os
import pathlib
import re
import tempfile
import unittest

from namespaces import need_network_of_its_own
from processes import SOURCES, eventually, stepwright

EXAMPLE = SOURCES / "doc/examples/openplc/plc.xml"
FOREIGN = pathlib.Path(os.environ.get("STEPWRIGHT_DATA", SOURCES.parent / "shared/data")).parent / "cases/iec"
TASK = '<task name="slow" priority="1" interval="T#100ms"><pouInstance name="run" typeName="Main"/></task>'


def project(variables, body, extra="", task=TASK):
    """A project of one program in ST, in the form of Beremiz."""
    listed = "".join(f'<variable name="{name}"{address}><type>{kind}</type></variable>' for name, address, kind in variables)
    return f"""<?xml version='1.0' encoding='utf-8'?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201" xmlns:xhtml="http://www.w3.org/1999/xhtml">
<fileHeader companyName="x" productName="x" productVersion="1" creationDateTime="2026-11-25T00:00:00"/>
<contentHeader name="Mixer"><coordinateInfo><fbd><scaling x="1" y="1"/></fbd><ld><scaling x="1" y="1"/></ld><sfc><scaling x="1" y="1"/></sfc></coordinateInfo></contentHeader>
<types><dataTypes/><pous><pou name="Main" pouType="program"><interface><localVars>{listed}</localVars></interface>
<body><ST><xhtml:p><![CDATA[{body}]]></xhtml:p></ST></body>{extra}</pou></pous></types>
<instances><configurations><configuration name="c"><resource name="r">{task}</resource></configuration></configurations></instances>
</project>
"""


class From(unittest.TestCase):
    def setUp(self):
        need_network_of_its_own()
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)

    def take(self, source, *arguments, name="line", runs=True):
        done = stepwright("new", name, "--from", source, *arguments, cwd=self.root)
        self.assertEqual(done.returncode, 0 if runs else 1, done.stdout + done.stderr)
        self.assertEqual("is a cell now" in done.stdout, runs, done.stdout)
        return self.root / name, done.stdout + done.stderr

    def write(self, text, name="plc.xml"):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def sound(self, folder):
        for path in folder.iterdir():
            self.assertNotIn("{{", path.read_text(encoding="utf-8"), path)
        checked = stepwright("check", cwd=folder)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""), checked.stdout)
        tested = stepwright("test", cwd=folder)
        self.assertEqual(tested.returncode, 0, tested.stdout + tested.stderr)

    def test_a_project_of_openplc_runs_with_its_tasks_and_its_inputs_and_outputs(self):
        folder, said = self.take(EXAMPLE)
        self.assertEqual({path.name for path in folder.iterdir()}, {"README.md", "cell.toml", "main.xml", "tests.st"})
        self.assertNotIn("not taken", said)
        readme = (folder / "README.md").read_text(encoding="utf-8")
        self.assertIn("| `instance0.motor` | `%QX0.0` | BOOL | contactor of the fan |", readme)
        self.assertIn("| task0 | 20000 µs | 0 | instance0 (Motor), instance1 (Speed) |", readme)
        self.assertIn("Nothing: all of it was taken.", readme)
        self.sound(folder)
        up = stepwright("up", "--port", 0, "--detach", cwd=folder)
        self.addCleanup(stepwright, "down", cwd=folder)
        self.assertEqual(up.returncode, 0, up.stdout + up.stderr)
        forced = stepwright("force", "--config", "cell.toml", "instance0.start", "TRUE", cwd=folder)
        self.assertEqual(forced.returncode, 0, forced.stderr)
        lamp = lambda: "instance0.lamp = TRUE" in stepwright("snapshot", "--config", "cell.toml", "instance0.lamp", cwd=folder).stdout
        self.assertTrue(eventually(lamp), "the ladder runs")

    def test_a_task_without_an_interval_and_a_project_without_addresses_are_told_as_that(self):
        task = '<task name="free" priority="1"><pouInstance name="run" typeName="Main"/></task>'
        folder, _ = self.take(self.write(project([("n", "", "<INT/>")], "n := n + 1;", task=task)))
        readme = (folder / "README.md").read_text(encoding="utf-8")
        self.assertIn("| free | whenever there is time | 1 | run (Main) |", readme)
        self.assertIn("The project has no variable with an address.", readme)
        self.assertNotIn("They are 0", readme)

    def test_addresses_that_are_apart_there_are_apart_here(self):
        folder, _ = self.take(EXAMPLE)
        xml = (folder / "main.xml").read_text(encoding="utf-8")
        self.assertIn('name="speed" address="%QW1"', xml)
        self.assertIn('name="motor" address="%QX0.0"', xml)
        readme = (folder / "README.md").read_text(encoding="utf-8")
        self.assertIn("| `%QW0` | `%QW1` |", readme)
        self.assertNotIn("| `%QX0.0` | `%QX0.0` |", readme)
        compiled = stepwright("compile", "--check", "--dialect", "matiec", folder / "main.xml")
        self.assertNotIn("W0016", compiled.stderr, "nothing overlaps any more")

    def test_addresses_with_levels_get_flat_ones_in_bodies_too(self):
        source = self.write(project([("lamp", ' address="%QX1.0.3"', "<BOOL/>"), ("count", ' address="%QW1.1.0"', "<INT/>"),
                                     ("button", ' address="%IX0.0.1"', "<BOOL/>")],
                                    "lamp := button OR %IX0.0.2; count := count + 1;"))
        folder, _ = self.take(source)
        xml = (folder / "main.xml").read_text(encoding="utf-8")
        self.assertIn('name="lamp" address="%QX0.0"', xml)
        self.assertIn('name="count" address="%QW1"', xml)
        self.assertIn("lamp := button OR %IX0.1;", xml)
        self.assertIn('"%QX0.0" = "zero"   # run.lamp', (folder / "cell.toml").read_text(encoding="utf-8"))
        self.sound(folder)

    def test_an_array_at_an_address_counts_with_its_whole_length(self):
        words = "<array><dimension lower=\"0\" upper=\"1\"/><dimension lower=\"0\" upper=\"4\"/><baseType><derived name=\"Pair\"/></baseType></array>"
        pair = '<dataTypes><dataType name="Pair"><baseType><struct><variable name="x"><type><INT/></type></variable><variable name="y"><type><INT/></type></variable></struct></baseType></dataType></dataTypes>'
        text = project([("a", ' address="%QX0.0"', "<BOOL/>"), ("w", ' address="%QW0"', words), ("b", ' address="%QW22"', "<INT/>"), ("third", ' address="%QW2"', "<INT/>")],
                       "a := TRUE; b := 777; w[1, 4].y := 5; third := 3;").replace("<dataTypes/>", pair)
        folder, said = self.take(self.write(text))
        self.assertNotIn("not taken", said)
        xml = (folder / "main.xml").read_text(encoding="utf-8")
        for name, address in (("w", "%QW1"), ("third", "%QW3"), ("b", "%QW21")):
            self.assertIn(f'name="{name}" address="{address}"', xml)
        self.assertIn("output_bytes = 44 ", (folder / "cell.toml").read_text(encoding="utf-8"))
        checked = stepwright("check", cwd=folder)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertNotRegex(checked.stderr, "W0016: 'b'|R0080")

    def test_texts_comments_and_documentation_keep_what_they_say(self):
        body = "IF s = 'was %QW0 $'%QX0.7' THEN w := 1; END_IF; (* %QW0 *) // %QW0\n w := %QW0;"
        text = project([("a", ' address="%QX0.5"', "<BOOL/>"), ("w", ' address="%QW0"', "<WORD/>"), ("s", "", "<string/>")], body)
        text = text.replace('<type><WORD/></type>', '<type><WORD/></type><documentation><xhtml:p>at %QW0</xhtml:p></documentation>')
        folder, _ = self.take(self.write(text))
        xml = (folder / "main.xml").read_text(encoding="utf-8")
        self.assertEqual(xml, text.replace('address="%QX0.5"', 'address="%QX0.0"').replace('address="%QW0"', 'address="%QW1"').replace("w := %QW0", "w := %QW1"))
        self.assertNotIn("%QX0.7", (folder / "README.md").read_text(encoding="utf-8"))
        self.sound(folder)

    def test_an_action_that_nothing_takes_is_said(self):
        bodies = ("<ST><xhtml:p>n := 0;</xhtml:p></ST>", "<IL><xhtml:p>LD n</xhtml:p></IL>", "<FBD/>")
        for number, body in enumerate(bodies):
            action = f'<actions><action name="Reset"><body>{body}</body></action></actions><body>'
            made, said = self.take(self.write(project([("n", "", "<INT/>")], "n := n + 1;").replace("<body>", action, 1)), name=f"line{number}")
            for words in (said, (made / "README.md").read_text(encoding="utf-8")):
                self.assertIn("Main.Reset: an action outside of a chart", words)
                self.assertNotIn("all of it was taken", words)

    def test_a_device_that_no_cell_takes_is_left_out_and_said(self):
        folder = self.root / "project"
        self.write(project([("level", ' address="%IW0.0.0.7"', "<WORD/>"), ("other", ' address="%IW0.1.0.7"', "<WORD/>")], ";"),
                   "project/plc.xml")
        node = lambda name, channel, settings: (self.write(f'<BaseParams IEC_Channel="{channel}" Name="x"/>', f"project/{name}/baseconfnode.xml"),
                                                self.write(settings, f"project/{name}/confnode.xml"))
        node("bus@modbus", 0, "<ModbusRoot/>")
        node("bus@modbus/good@ModbusTCPclient", 1, '<ModbusTCPclient Remote_IP_Address="10.0.0.9"/>')
        node("bus@modbus/good@ModbusTCPclient/a@ModbusRequest", 0, '<ModbusRequest Function="04 - Read Input Registers" Nr_of_Channels="8"/>')
        node("bus@modbus/bad@ModbusTCPclient/a@ModbusRequest", 0, '<ModbusRequest Function="04 - Read Input Registers" Nr_of_Channels="8"/>')
        for number, (port, why) in enumerate((("99999", "must lie between 1 and 65535"), ("abc", "must be a whole number"), ("1\\", "must be a whole number"))):
            node("bus@modbus/bad@ModbusTCPclient", 0, f'<ModbusTCPclient Remote_IP_Address="10.0.0.8" Remote_Port_Number="{port}"/>')
            made, said = self.take(folder, name=f"line{number}")
            for words in (said, (made / "README.md").read_text(encoding="utf-8")):
                self.assertRegex(words, rf"the device 'bad unit 1' is not in cell\.toml: 'modbus\.device\.port' .*{why}")
            cell = (made / "cell.toml").read_text(encoding="utf-8")
            self.assertIn('host = "10.0.0.9"', cell)
            self.assertNotIn("10.0.0.8", cell)
            checked = stepwright("check", cwd=made)
            self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_addresses_that_do_not_overlap_stay(self):
        source = self.write(project([("a", ' address="%QX4.1"', "<BOOL/>"), ("b", ' address="%QW5"', "<INT/>")], "a := TRUE; b := 1;"))
        folder, _ = self.take(source)
        self.assertEqual((folder / "main.xml").read_text(encoding="utf-8"), source.read_text(encoding="utf-8"))
        self.assertNotIn("Addresses that are others here", (folder / "README.md").read_text(encoding="utf-8"))
        self.assertIn("output_bytes = 12", (folder / "cell.toml").read_text(encoding="utf-8"))

    def test_the_example_of_devices_is_a_table_that_check_takes(self):
        folder, _ = self.take(EXAMPLE)
        cell = folder / "cell.toml"
        text = cell.read_text(encoding="utf-8")
        head, example = text.split("# [io]\n")
        head = re.sub(r"(?m)^\[plant\]\nkind.*\n", "", head)
        cell.write_text(head + "[io]\n" + re.sub(r"(?m)^# ?", "", example), encoding="utf-8")
        checked = stepwright("check", cwd=folder)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""), checked.stdout)

    def test_devices_over_modbus_that_beremiz_keeps_beside_the_project_are_taken(self):
        folder = self.root / "project"
        self.write(project([("level", ' address="%IW2.0.1.7"', "<WORD/>"), ("valve", ' address="%QX2.0.0.3"', "<BOOL/>"),
                            ("flag", ' address="%QX2.0.0.0.0"', "<BOOL/>"), ("beyond", ' address="%QX2.0.0.8"', "<BOOL/>"), ("before", ' address="%IW2.0.1.6"', "<INT/>"),
                            ("rows", ' address="%IW2.0.1.10"', '<array><dimension lower="0" upper="3"/><baseType><INT/></baseType></array>')], "valve := level < WORD#500;"), "project/plc.xml")
        node = lambda name, channel, settings: (self.write(f'<BaseParams IEC_Channel="{channel}" Name="x"/>', f"project/{name}/baseconfnode.xml"),
                                                self.write(settings, f"project/{name}/confnode.xml"))
        node("bus@modbus", 2, "<ModbusRoot/>")
        node("bus@modbus/press@ModbusTCPclient", 0,
             '<ModbusTCPclient Remote_IP_Address="10.0.0.9" Remote_Port_Number="1502" Invocation_Rate_in_ms="200"/>')
        node("bus@modbus/press@ModbusTCPclient/a@ModbusRequest", 0, '<ModbusRequest Function="15 - Write Multiple Coils" SlaveID="4" Nr_of_Channels="8"/>')
        node("bus@modbus/press@ModbusTCPclient/b@ModbusRequest", 1, '<ModbusRequest Function="04 - Read Input Registers" SlaveID="4" Start_Address="7" Nr_of_Channels="8" Timeout_in_ms="450"/>')
        node("bus@modbus/ours@ModbusTCPserver", 1, "<ModbusServerNode/>")
        made, said = self.take(folder)
        cell = (made / "cell.toml").read_text(encoding="utf-8")
        for part in ('[io]\nkind = "modbus"', 'name = "press unit 4"\nhost = "10.0.0.9"\nport = 1502\nunit = 4', "period_ms = 200", "timeout_ms = 450",
                     'address = "%IW1", input = 7, type = "uint16" }', 'name = "run.valve", address = "%QX0.1", coil = 3 }'):
            self.assertIn(part, cell)
        for name in ("flag at %QX2.0.0.0.0", "beyond at %QX2.0.0.8", "before at %IW2.0.1.6"):
            self.assertIn(f"run.{name}: no request", said)
        self.assertIn("run.rows at %IW2.0.1.10: ARRAY[0..3] OF INT, of which only the first value has a tag in cell.toml", said)
        self.assertIn("bus/ours: a ModbusTCPserver", said)
        self.sound(made)

    def test_a_project_in_latin_letters_is_taken_with_its_words(self):
        text = project([("a", ' address="%QX0.0"', "<BOOL/>")], "a := TRUE;")
        text = text.replace("<BOOL/></type>", "<BOOL/></type><documentation><xhtml:p>Kühlung 20 °C</xhtml:p></documentation>", 1)
        self.assertIn("Kühlung", text)
        head = re.sub(r"<\?xml.*?\?>", "", text, count=1)
        source = self.root / "latin.xml"
        source.write_bytes(b'<?xml version="1.0" encoding="ISO-8859-1"?>' + head.encode("latin-1"))
        made, _ = self.take(source)
        self.assertIn('description = "Kühlung 20 °C"', (made / "cell.toml").read_text(encoding="utf-8"))
        self.sound(made)
        self.assertTrue((made / "main.xml").read_text(encoding="utf-8").startswith('<?xml version="1.0" encoding="UTF-8"?>'))
        source.write_bytes(b'<?xml version="1.0" encoding="UTF-8"?>' + head.encode("latin-1"))
        done = stepwright("new", self.root / "other", "--from", source)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"latin\.xml:\d+:\d+: E0801: this byte is not of UTF-8")

    def test_a_project_without_instances_is_told_at_its_configuration(self):
        source = self.write(project([("a", "", "<BOOL/>")], "a := TRUE;", task='<task name="slow" interval="T#1s" priority="0"/>'))
        made, said = self.take(source, runs=False)
        self.assertRegex(said, r"main\.xml:\d+:\d+: E0601")
        self.assertNotIn(".cfg:", said)

    def test_what_is_left_is_said_and_the_rest_is_written(self):
        folder = self.root / "project"
        self.write(project([("a", "", "<BOOL/>"), ("told", "", '<derived name="LOGGER"/>'), ("lost", "", '<derived name="RTC_CLOCK"/>')],
                           "a := lost.Q;", extra='<addData><data name="http://maker.example/layout" handleUnknown="discard"/></addData>'),
                   "project/plc.xml")
        (folder / "opcua_0@opcua").mkdir()
        made, said = self.take(folder, runs=False)
        self.assertIn("it does not run", said)
        for text in (said, (made / "README.md").read_text(encoding="utf-8")):
            self.assertIn("RTC_CLOCK", text)
            self.assertIn("Main.told: a LOGGER does nothing here", text)
            self.assertIn("http://maker.example/layout", text)
            self.assertIn("opcua_0@opcua", text)
        self.assertIn("main.xml:", said, "what does not compile has its place")
        self.assertEqual(stepwright("check", cwd=made).returncode, 1)

    def test_what_is_drawn_and_hangs_on_nothing_is_said_and_so_is_a_program_without_a_body(self):
        contact = ('<contact localId="2"><position x="50" y="10"/><connectionPointIn/><connectionPointOut/><variable>a</variable></contact>'
                   '<coil localId="3"><position x="90" y="10"/><connectionPointIn><connection refLocalId="2"/></connectionPointIn><connectionPointOut/>'
                   '<variable>b</variable></coil>')
        drawn = f'<LD><leftPowerRail localId="1"><position x="0" y="0"/><connectionPointOut formalParameter=""/></leftPowerRail>{contact}</LD>'
        idle = ('<pou name="Idle" pouType="program"><interface/><body><ST><xhtml:p><![CDATA[ ]]></xhtml:p></ST></body></pou>'
                '<pou name="Rail" pouType="program"><interface/><body><LD><leftPowerRail localId="1"><position x="0" y="0"/>'
                '<connectionPointOut formalParameter=""/></leftPowerRail></LD></body></pou>')
        text = project([("a", "", "<BOOL/>"), ("b", "", "<BOOL/>")], "@@").replace("<ST><xhtml:p><![CDATA[@@]]></xhtml:p></ST>", drawn)
        made, said = self.take(self.write(text.replace("</pous>", idle + "</pous>")))
        for words in (said, (made / "README.md").read_text(encoding="utf-8")):
            self.assertRegex(words, r"main\.xml:\d+:\d+: W0021: POU 'Main', network 1, contact 'a': no wire leads to it: it never has power")
            self.assertIn("Idle: it has no body", words)
            self.assertIn("Rail: it has no body", words)
            self.assertNotIn("all of it was taken", words)

    def test_an_instruction_list_is_left_out_and_the_rest_runs(self):
        lists = ('<pou name="OldIL" pouType="program"><interface/><body><IL><xhtml:p><![CDATA[LD a (* </pou> *)]]></xhtml:p></IL></body></pou>'
                 '<pou name="Idle" pouType="functionBlock"><interface/><body><IL><xhtml:p>RET</xhtml:p></IL></body></pou>')
        task = TASK.replace("</task>", '<pouInstance name="old" typeName="OldIL"><documentation><xhtml:p>of 1998</xhtml:p></documentation></pouInstance></task>')
        text = project([("a", "", "<BOOL/>")], "a := NOT a;", task=task).replace("</pous>", lists + "</pous>")
        made, said = self.take(self.write(text))
        for words in (said, (made / "README.md").read_text(encoding="utf-8")):
            self.assertIn("OldIL: an instruction list, which is not read; old in the task slow does not run", words)
            self.assertIn("Idle: an instruction list", words)
        xml = (made / "main.xml").read_text(encoding="utf-8")
        self.assertEqual(xml, text.replace(lists, "").replace(task, TASK))
        self.sound(made)

    def test_what_a_program_calls_of_an_instruction_list_keeps_the_cell_from_running(self):
        lists = '<pou name="Old" pouType="functionBlock"><interface/><body><IL><xhtml:p>RET</xhtml:p></IL></body></pou>'
        calls = project([("old", "", '<derived name="Old"/>')], "old();").replace("</pous>", lists + "</pous>")
        made, said = self.take(self.write(calls), runs=False)
        self.assertIn("Old: an instruction list", said)
        self.assertRegex(said, r"main\.xml:\d+:\d+: error: E\d{4}: .*Old|main\.xml:\d+:\d+: E\d{4}: .*Old")
        self.assertEqual(stepwright("check", cwd=made).returncode, 1)

    def test_where_all_that_runs_is_an_instruction_list_nothing_else_begins_to(self):
        text = project([("a", "", "<BOOL/>")], "a := NOT a;", task=TASK.replace("Main", "OldIL")).replace(
            "</pous>", '<pou name="OldIL" pouType="program"><interface/><body><IL><xhtml:p>LD a</xhtml:p></IL></body></pou></pous>')
        made, said = self.take(self.write(text), runs=False)
        self.assertIn("E0804", said)
        self.assertEqual((made / "main.xml").read_text(encoding="utf-8"), text)

    def test_a_task_of_a_program_that_is_not_there_is_no_cell_that_runs(self):
        made, said = self.take(self.write(project([("a", "", "<BOOL/>")], "a := TRUE;", task=TASK.replace("Main", "MyProg"))), runs=False)
        self.assertIn("E0603", said)
        self.assertIn("E0603", (made / "README.md").read_text(encoding="utf-8"))

    def test_a_name_of_two_words_is_told_whole_at_its_place_and_nothing_is_written(self):
        source = self.write(project([("a", "", "<BOOL/>")], "a := TRUE;", task=TASK.replace("Main", "My Prog")))
        done = stepwright("new", "line", "--from", source, cwd=self.root)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"plc\.xml:\d+:\d+: E0802: 'My Prog' of <pouInstance> is no name\n  hint: .*My_Prog")
        self.assertFalse((self.root / "line").exists())

    def test_what_is_no_project_is_refused_and_nothing_is_written(self):
        empty = self.root / "empty"
        empty.mkdir()
        for source, code in ((self.write('{"meta": {}}', "project.json"), "M0020"), (empty, "M0020"),
                             (self.root / "absent.xml", "E0001"), (self.write("<a>", "half.xml"), "E0801"),
                             (self.write("<svg/>", "other.xml"), "E0802")):
            done = stepwright("new", "line", "--from", source, cwd=self.root)
            self.assertEqual(done.returncode, 1, f"{source}: {done.stdout}")
            self.assertIn(code, done.stderr)
            self.assertFalse((self.root / "line").exists())
        self.assertEqual(stepwright("new", "line", "--from", EXAMPLE, "--plant", "tanks", cwd=self.root).returncode, 2)

    def test_a_project_of_several_devices_has_its_configuration_named(self):
        two = project([("a", "", "<BOOL/>")], "a := TRUE;").replace(
            "</configuration></configurations>", '</configuration><configuration name="other"><resource name="r"/></configuration></configurations>')
        source = self.write(two)
        done = stepwright("new", "line", "--from", source, cwd=self.root)
        self.assertEqual(done.returncode, 1)
        self.assertIn("other", done.stderr)
        self.take(source, "--configuration", "c")

    def test_projects_of_others(self):
        """Files in the forms of other systems, where they are."""
        found = sorted(FOREIGN.glob("*.xml"))
        if not found:
            self.skipTest(f"there are no projects in {FOREIGN}")
        for number, source in enumerate(found):
            with self.subTest(source.name):
                folder = self.root / f"cell{number}"
                taken = stepwright("new", folder.name, "--from", source, "--dialect", "codesys" if "codesys" in source.name else "matiec",
                                   cwd=self.root)
                checked = stepwright("check", cwd=folder)
                self.assertEqual("does not compile" in taken.stdout, taken.returncode == 1, taken.stdout + taken.stderr)
                self.assertEqual(taken.returncode, checked.returncode, taken.stdout + checked.stderr)
                stepwright("check", "--json", "checked.json", cwd=folder)
                checked = json.loads((folder / "checked.json").read_text(encoding="utf-8"))
                self.assertEqual([each for each in checked["diagnostics"] if each["code"].startswith("C")], [])


if __name__ == "__main__":
    unittest.main()
