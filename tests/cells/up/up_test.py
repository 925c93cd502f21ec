"""`stepwright up`: all processes of a cell come up, are started again when they are killed, and end in order."""

import os
import pathlib
import re
import signal
import unittest

from kept_cell import DEVICES, PAGE, RUNS, KeptCell, alive
from processes import SOURCES, eventually, get, stepwright

ORDER = ["hmi", "link", "runtime"]
TANK = pathlib.Path(__file__).parent.parent / "shared_plant/tank.py"
PRINTS = """\
[plant]
kind = "shared"
command = ["python3", "tank.py"]
[plant.sensors]
level = "%IW0"
full = "%IX4.0"
[plant.actuators]
valve = "%QX0.0"
drain = "%QX0.1"
[plant.values]
volume = "l"
[plant.faults]
leak = "m/s"
"""


def ended(process):
    """The names in the order in which they were ended."""
    return re.findall(r"^up +\| ends ([\w-]+)$", process.output(), re.M)


class Up(unittest.TestCase):
    def kept(self, **options):
        cell = KeptCell(**options)
        self.addCleanup(cell.__exit__)
        return cell

    def test_all_processes_come_up_and_the_page_is_there(self):
        cell = self.kept()
        process = cell.ready()
        process.wait_for(r"set-up token [A-Z2-9-]{24} \(once\)")
        status = cell.run("status", "--json")
        self.assertEqual(status.returncode, 0, status.stdout + status.stderr)
        record = cell.status()
        self.assertEqual([each["name"] for each in record["processes"]], ORDER)
        self.assertEqual({each["phase"] for each in record["processes"]}, {"ready"})
        self.assertEqual((record["ready"], record["pid"]), (True, process.pid))
        self.assertEqual(get(cell.port(), "/")[0].status, 200)
        process.wait_for(re.escape(record["address"]))
        self.assertRegex(cell.run("status").stdout, r"(?m)^  runtime +ready +process \d+$")
        self.assertNotIn("\x1b", process.output(), "no colours in a file")
        process.wait_for(r"(?m)^runtime \| .*listens on")

    def test_the_program_of_the_sources_runs(self):
        cell = self.kept()
        cell.ready()
        read = eventually(lambda: re.search(r"Main\.n = (\d+)", stepwright("snapshot", "--config", cell.config, "Main.n").stdout))
        self.assertTrue(read)
        self.assertTrue((cell.state / "program.swb").exists())

    def is_replaced(self, cell, process, name, by):
        """After the signal there is another process of that name, for the first time."""
        before = cell.of(name)["pid"]
        os.kill(before, by)

        def back():
            now = cell.of(name)
            return now["phase"] == "ready" and now["pid"] != before and now["restarts"] == 1
        self.assertTrue(eventually(back), process.output())

    def test_what_is_killed_is_started_again(self):
        cell = self.kept()
        process = cell.ready()
        for name in ORDER:
            self.is_replaced(cell, process, name, signal.SIGKILL)
            process.wait_for(rf"(?m)^{name} +\| was ended by the signal KILL: it is started again in 0\.1 s$")
        self.assertEqual(get(cell.port(), "/")[0].status, 200)
        self.assertEqual(cell.run("status").returncode, 0)

    def test_what_hangs_is_killed_and_started_again(self):
        cell = self.kept(more=DEVICES)
        process = cell.ready()
        for name, silence in {"modbus-client": 5, "hmi": 15, "link": 5}.items():  # a runtime that hangs is its guard's
            self.is_replaced(cell, process, name, signal.SIGSTOP)
            process.wait_for(rf"(?m)^{name} +\| gave no sign of life for {silence}\.0 s: it hangs, and is killed$")
            self.assertRegex(cell.run("status").stdout, rf"(?m)^  {name} .*the last time because it gave no sign of life for {silence}\.0 s$")

    def test_a_supervisor_that_hangs_is_killed_and_goes_on(self):
        cell = self.kept(config=SOURCES / "tests/cells/bench/cell.toml")
        process = cell.ready("--set", "executive.start=operator")
        self.is_replaced(cell, process, "supervisor", signal.SIGSTOP)
        process.wait_for(r"(?m)^supervisor +\| gave no sign of life for 30\.0 s: it hangs, and is killed$")
        self.assertEqual({each["restarts"] for each in cell.status()["processes"] if each["name"] != "supervisor"}, {0})
        self.assertEqual(cell.run("status").returncode, 0)

    def test_ctrl_c_ends_all_in_order(self):
        cell = self.kept()
        process = cell.ready()
        pids = cell.pids().values()
        process.send(signal.SIGINT)
        self.assertEqual(process.wait(), 0, process.output())
        self.assertEqual(ended(process), ORDER)
        self.assertRegex(process.output(), r"(?m)^runtime \| .*'kept-\d+' ends$")
        self.assertTrue(cell.nothing_is_left(pids))

    def test_the_supervisor_of_a_planned_cell_ends_first(self):
        cell = self.kept(config=SOURCES / "tests/cells/bench/cell.toml")
        process = cell.ready("--set", "executive.start=operator")
        self.assertEqual(list(cell.pids()), ["hmi", "link", "runtime", "supervisor"])
        process.send(signal.SIGTERM)
        self.assertEqual(process.wait(), 0, process.output())
        self.assertEqual(ended(process), ["supervisor", *ORDER])

    def test_who_keeps_them_is_killed_then_they_end_too(self):
        cell = self.kept()
        process = cell.ready()
        pids = cell.pids().values()
        process.end(signal.SIGKILL)
        self.assertTrue(cell.nothing_is_left(pids))
        cell.ready()

    def test_down_ends_it_and_status_says_so(self):
        cell = self.kept()
        process = cell.ready()
        pids = cell.pids().values()
        down = cell.run("down")
        self.assertEqual(down.returncode, 0, down.stderr)
        self.assertRegex(down.stdout, r"^cell 'kept-\d+' is down\n$")
        self.assertEqual(process.wait(), 0)
        self.assertTrue(cell.nothing_is_left(pids))
        status = cell.run("status")
        self.assertEqual(status.returncode, 5)
        self.assertIn("is not up; `stepwright up", status.stdout)
        again = cell.run("down")
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertIn("is not up", again.stdout)

    def test_detached_it_returns_when_the_cell_is_ready(self):
        cell = self.kept()
        done = cell.run("up", "--detach")
        self.addCleanup(cell.run, "down")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"is ready: http://127\.0\.0\.1:\d+/")
        self.assertRegex(done.stdout, r"set-up token [A-Z2-9-]{24}")
        self.assertEqual(get(cell.port(), "/")[0].status, 200)
        self.assertEqual(cell.run("status").returncode, 0)
        pids = [cell.status()["pid"], *cell.pids().values()]
        self.assertTrue(all(alive(pid) for pid in pids))
        self.assertEqual(cell.run("down").returncode, 0)
        self.assertTrue(cell.nothing_is_left(pids))

    def test_detached_its_log_does_not_grow_without_end(self):
        cell = self.kept(more=PRINTS + RUNS + PAGE)
        tank = TANK.read_text(encoding="utf-8")
        step = "    seconds ="
        self.assertIn(step, tank)
        (cell.folder / "tank.py").write_text(tank.replace(step, f"    print('x' * 65_536, flush=True)\n{step}", 1), encoding="utf-8")
        done = cell.run("up", "--detach")
        self.addCleanup(cell.run, "down")
        self.assertEqual(done.returncode, 0, done.stderr)
        log, older = cell.state / "up.log", cell.state / "up.log.1"
        self.assertTrue(eventually(lambda: older.exists() and log.exists()))
        for file in (log, older):
            self.assertLessEqual(file.stat().st_size, 16 << 20)
            self.assertEqual(file.stat().st_mode & 0o777, 0o600, "the set-up token stands in it")
        self.assertEqual(cell.run("status").returncode, 0)

    def test_in_the_folder_of_the_cell_its_file_need_not_be_named(self):
        cell = self.kept()
        done = stepwright("up", "--detach", cwd=cell.folder)
        self.addCleanup(stepwright, "down", cwd=cell.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(stepwright("status", cwd=cell.folder).returncode, 0)
        elsewhere = stepwright("up", cwd=cell.state)
        self.assertEqual(elsewhere.returncode, 1)
        self.assertIn("cell.toml: M0012: there is no such cell", elsewhere.stderr)
        self.assertIn("stepwright new", elsewhere.stderr)


if __name__ == "__main__":
    unittest.main()
