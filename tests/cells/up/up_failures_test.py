"""`stepwright up` of a cell that cannot come up: clear words, and nothing of it is left; and of one that loses a process."""

import os
import re
import shutil
import signal
import socket
import unittest

from kept_cell import DEVICES, NO_PLANT, PAGE, RUNS, KeptCell
from processes import BIN, eventually, stepwright

FAILS = "#!/bin/sh\necho this link cannot live\nexit 5\n"
HANGS = """\
#!/usr/bin/env python3
import os, signal, socket
signal.signal(signal.SIGTERM, signal.SIG_IGN)
init = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
init.sendto(b"READY=1", "\\0" + os.environ["NOTIFY_SOCKET"][1:])
while True:
    signal.pause()
"""


class Failures(unittest.TestCase):
    def kept(self, **options):
        cell = KeptCell(**options)
        self.addCleanup(cell.__exit__)
        return cell

    def programs(self, cell):
        """A folder of programs of the test's own, where one can be replaced; the command in it."""
        folder = cell.folder / "bin"
        folder.mkdir()
        for program in BIN.glob("stepwright*"):
            if program.name in ("stepwright", "stepwright-up"):  # they look beside the file that they are
                shutil.copy(program, folder)
            else:
                (folder / program.name).symlink_to(program)
        cell.command = folder / "stepwright"
        return folder

    def replace(self, program, text):
        beside = program.with_name("beside")
        beside.write_text(text, encoding="utf-8")
        beside.chmod(0o755)
        os.replace(beside, program)

    def replace_link(self, folder):
        self.replace(folder / "stepwright-link", FAILS)

    def refused(self, cell, code, *arguments):
        """Runs it to its end; what it said."""
        process = cell.up(*arguments)
        self.assertEqual(process.wait(), code, process.output())
        record = cell.run("status", "--json")
        self.assertEqual(record.returncode, 5, record.stdout)
        self.assertFalse((cell.state / "up.json").exists())
        return process.output()

    def test_a_second_one_is_refused_and_the_first_goes_on(self):
        cell = self.kept()
        first = cell.ready()
        second = cell.run("up")
        self.assertEqual(second.returncode, 1)
        self.assertIn(f"M0013: the cell '{cell.status()['cell']}' is up already: process {first.pid}, page http://", second.stderr)
        self.assertIn("`stepwright down ", second.stderr)
        self.assertEqual(cell.run("status").returncode, 0)

    def test_a_port_in_use_is_told_before_anything_moves(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            cell = self.kept(more=NO_PLANT + RUNS + f"[hmi]\nport = {port}\n")
            said = self.refused(cell, 1)
            self.assertIn(f"H0001: port {port} of 127.0.0.1 is in use by another program", said)
            self.assertIn("--port", said)
            self.assertIn("is not up: hmi has failed", said)
            self.assertNotRegex(said, r"(?m)^runtime +\|")
            self.assertNotIn("is ready", said)
            process = cell.ready("--port", "0")
            self.assertTrue(process.running())

    def test_a_missing_program_is_named_before_anything_is_started(self):
        cell = self.kept()
        (self.programs(cell) / "stepwright-link").unlink()
        said = self.refused(cell, 5)
        self.assertIn("M0001: the program of 'link' is missing", said)
        self.assertNotIn("hmi", said.replace("hmi.port", ""))

    def test_who_fails_at_once_five_times_ends_the_start(self):
        cell = self.kept()
        self.replace_link(self.programs(cell))
        said = self.refused(cell, 5)
        self.assertEqual(said.count("this link cannot live"), 5, said)
        self.assertIn("ended with 5, 5 times before it was ready: it is left alone", said)
        self.assertIn("is not up: link has failed", said)
        self.assertIn("`stepwright check --config ", said)
        self.assertIn("ends hmi", said)

    def test_who_fails_later_is_left_alone_and_the_others_go_on(self):
        cell = self.kept()
        folder = self.programs(cell)
        process = cell.ready()
        self.replace_link(folder)
        before = cell.pids()
        os.kill(before["link"], signal.SIGKILL)
        self.assertTrue(eventually(lambda: cell.of("link")["phase"] == "failed"), process.output())
        process.wait_for("link is left alone, the others go on")
        self.assertEqual(cell.run("status").returncode, 5)
        after = cell.pids()
        self.assertEqual({name: after[name] for name in ("hmi", "runtime")}, {name: before[name] for name in ("hmi", "runtime")})
        self.assertEqual(cell.run("down").returncode, 0)
        self.assertEqual(process.wait(), 5)

    def test_down_says_what_a_process_that_had_to_be_killed_leaves_behind(self):
        cell = self.kept(more=DEVICES)
        self.replace(self.programs(cell) / "stepwright-modbus-client", HANGS)
        process = cell.ready()
        pids = cell.pids().values()
        down = cell.run("down")
        self.assertEqual(down.returncode, 5, down.stdout + down.stderr)
        self.assertIn("M0021: modbus-client did not end and was killed", down.stderr)
        self.assertIn("the outputs of the devices may still be on", down.stderr)
        self.assertEqual(process.wait(), 5, process.output())
        self.assertIn("modbus-client does not end: it is killed; the outputs of the devices may still be on", process.output())
        self.assertTrue(cell.nothing_is_left(pids))
        self.assertEqual(cell.run("status").returncode, 5)
        self.assertEqual(cell.status()["killed"], ["modbus-client"])
        self.assertIn("modbus-client  did not end and was killed: the outputs of the devices may still be on", cell.run("status").stdout)

    def test_a_cell_whose_state_folder_is_that_of_another_one_leaves_that_alone(self):
        cell, other = self.kept(), self.kept()
        shared = other.config.read_text(encoding="utf-8").replace('state_dir = "state"', f'state_dir = "{cell.state}"')
        other.config.write_text(shared, encoding="utf-8")
        process = cell.ready()
        for command, code in (("up", 1), ("status", 5), ("down", 5)):
            done = other.run(command)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            self.assertRegex(done.stderr, rf"^{re.escape(str(other.config))}: M0023: .*is that of another cell, which is up: .*{re.escape(str(cell.config))}")
            self.assertIn("[cell] state_dir", done.stderr)
        for command in (("force", "Main.n", "1"), ("snapshot", "Main.n"), ("stop",), ("download", cell.state / "program.swb", "--replace")):
            done = stepwright(command[0], "--config", other.config, *command[1:])
            self.assertNotEqual(done.returncode, 0, (command, done.stdout))
            self.assertIn("M0023", done.stderr, command)
        self.assertTrue(process.running())
        self.assertEqual(cell.run("status").returncode, 0)
        self.assertEqual(cell.run("down").returncode, 0)
        self.assertIn("is not up", other.run("status").stdout)

    def test_a_state_folder_that_anybody_may_write_to_is_refused(self):
        cell = self.kept()
        cell.state.mkdir()
        cell.state.chmod(0o777)
        said = self.refused(cell, 1)
        self.assertIn("R0078: everybody may write into the state folder", said)

    def test_a_program_that_does_not_compile_starts_nothing(self):
        cell = self.kept(program="PROGRAM Main\n  VAR n : INT; END_VAR\n  n := m;\nEND_PROGRAM\n")
        said = self.refused(cell, 1)
        self.assertRegex(said, r"main\.st:3:8: .*E\d{4}")
        self.assertIn("is not up: its program does not compile", said)
        self.assertNotIn("listens", said)

    def test_a_source_that_is_not_there_is_told_at_its_place(self):
        cell = self.kept(more=NO_PLANT + PAGE + '[runtime]\nsources = ["mian.st"]\n')
        said = self.refused(cell, 1)
        self.assertRegex(said, r"cell\.toml:\d+:\d+: C0006: there is no file .*mian\.st")

    def test_down_works_whatever_has_become_of_the_file(self):
        cell = self.kept()
        process = cell.ready()
        cell.config.write_text(cell.config.read_text(encoding="utf-8") + "[typo]\n", encoding="utf-8")
        self.assertEqual(cell.run("down").returncode, 0)
        self.assertEqual(process.wait(), 0)
        self.assertEqual(stepwright("up", cell.config).returncode, 1)


if __name__ == "__main__":
    unittest.main()
