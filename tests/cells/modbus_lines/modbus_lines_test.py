"""Devices on serial lines as the I/O of a cell, with the real processes: several units on one line, of which some die, with
slaves of pymodbus, of npm's modbus-serial and of our own; a line that breaks and returns, again and again."""

import json
import os
import pathlib
import random
import re
import signal
import socket
import subprocess
import time
import tty
import unittest

from processes import TESTS, Cell, Process, eventually, stepwright

HERE = pathlib.Path(__file__).parent
PLC = HERE.parent / "modbus_io" / "pymodbus_plc.py"
BREAKS = int(os.environ.get("STEPWRIGHT_CUTS", "100"))
GOOD = 192
PATIENCE_S = 300
SETTLED_S = 3

HEAD = """\
[clock]
mode = "real"
[image]
input_bytes = 32
output_bytes = 32
[io]
kind = "modbus"
[guard]
timeout_ms = 60_000
[modbus.client]
holder_timeout_ms = 60_000
[modbus.lines."LINE"]
baud = 19_200
parity = "none"
stop_bits = 1
"""
UNIT = """\
[[modbus.device]]
name = "unitUNIT"
line = "LINE"
unit = UNIT
timeout_ms = 600
loss_after_ms = 30_000
retry_most_ms = 2_000
on_loss = "hold"
[[modbus.device.group]]
period_ms = 50
tags = [
  { name = "levelUNIT", address = "%IWNEXT", input = 0 },
]
"""
# The counter goes to the slave and comes back with half its value; what an input is worth stands in the image.
BREAKING = """\
[[modbus.device]]
name = "plc"
line = "LINE"
timeout_ms = 1_000
loss_after_ms = 3_000
on_loss = "LOSS"
[[modbus.device.group]]
period_ms = 20
tags = [
  { name = "half", address = "%IW0", input = 0, quality = "%IB4", loss_value = -7 },
  { name = "count", address = "%QW0", holding = 0 },
]
[safe_state.lost_io]
"%QW0" = { value = 14 }
"""
PROGRAM = """\
PROGRAM Main
  VAR
    half AT %IW0 : INT;
    quality AT %IB4 : USINT;
    count AT %QW0 : INT;
    worst : INT;
    least : INT := 255;
  END_VAR
  count := (count + 2) MOD 20000;
  IF half < worst THEN worst := half; END_IF;
  IF USINT_TO_INT(quality) < least THEN least := USINT_TO_INT(quality); END_IF;
END_PROGRAM

CONFIGURATION Press
  RESOURCE Cpu ON Plc
    TASK Fast(INTERVAL := T#20ms, PRIORITY := 1);
    PROGRAM main WITH Fast : Main;
  END_RESOURCE
END_CONFIGURATION
"""


class BreakableLine:
    """A pair of pseudo terminals, of which the master's goes with the socat that makes it; the slave's stays."""

    def __init__(self, folder, name="line"):
        self.master = folder / name
        self.ours, self.theirs = os.openpty()
        tty.setraw(self.theirs)
        self.slave = os.ttyname(self.theirs)
        self.process = None
        self.mend()

    def cut(self, number=signal.SIGKILL):
        # The number of its pseudo terminal is free at once, and may be another test's before the client looks.
        self.master.unlink(missing_ok=True)
        self.process.send_signal(number)
        self.process.wait()

    def mend(self):
        self.process = subprocess.Popen(["socat", f"FD:{self.ours}", f"pty,raw,echo=0,link={self.master}"], pass_fds=[self.ours])
        assert eventually(self.master.exists, PATIENCE_S, 0.001), "socat made no line"

    def close(self):
        self.cut()
        os.close(self.ours)
        os.close(self.theirs)


class OnALine(unittest.TestCase):
    def make(self, devices, program=None):
        self.cell = Cell("")
        self.addCleanup(self.cell.__exit__)
        self.addCleanup(lambda: pathlib.Path(f"/dev/shm/stepwright-io-{self.cell.name}").unlink(missing_ok=True))
        self.line = BreakableLine(self.cell.folder)
        self.addCleanup(self.line.close)
        more = (HEAD + devices).replace("LINE", str(self.line.master))
        if program:
            source, image = self.cell.folder / "press.st", self.cell.folder / "press.swb"
            source.write_text(program, encoding="utf-8")
            done = stepwright("compile", source, "-o", image)
            self.assertEqual(done.returncode, 0, done.stderr)
            more += f'[runtime]\nprogram = "{image}"\nautostart = true\n'
        self.cell.write(more)

    def start_slave(self, arguments, said, **options):
        slave = Process(arguments, self.cell.folder / f"slave{len(self.cell.processes)}.log", **options)
        self.cell.processes.append(slave)
        slave.wait_for(said, PATIENCE_S)
        return slave

    def start_plc(self, *units, line=None):
        return self.start_slave(["/usr/bin/python3", PLC, "line", (line or self.line).slave, *units], "PLC at")

    def devices(self):
        """What the client says, by name of the device; nothing if it does not answer."""
        with socket.socket(socket.AF_UNIX) as asked:
            if asked.connect_ex(str(self.cell.state / "modbus-client.sock")) != 0:
                return {}
            parts = []
            while part := asked.recv(65536):
                parts.append(part)
        return {each["name"]: each for each in json.loads(b"".join(parts))["devices"]}

    def tag(self, device, name):
        found = self.devices().get(device)
        return next((each for each in found["tags"] if each["name"] == name), None) if found else None

    def value(self, name):
        """Of the program's variable."""
        told = stepwright("snapshot", "--config", self.cell.config, f"MAIN.{name}")
        self.assertEqual(told.returncode, 0, told.stderr)
        return int(re.search(rf"(?i){name}\b\D*?(-?\d+)", told.stdout).group(1))


def failed_of(device):
    """Tries of it: without an answer, and with one that comes late and is another's."""
    return device["timeouts"] + device["bad_answers"]


def units_of(*units):
    """A device for each unit, in its own word of the inputs."""
    return "".join(UNIT.replace("UNIT", str(unit)).replace("NEXT", str(word)) for word, unit in enumerate(units))


class Units(OnALine):
    def watch(self, names, seconds=SETTLED_S):
        """The oldest that each device's value was while it was looked at, in ms; -1 where it was good and then was not
        although the device itself had always answered in time."""
        oldest = dict.fromkeys(names, 0)
        before = self.devices()
        seen_good = set()  # not before its first answer, if it had missed one just before the look began
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for name, device in self.devices().items():
                if name not in oldest or oldest[name] < 0 or failed_of(device) != failed_of(before[name]):
                    continue
                tag = device["tags"][0]
                if tag["quality"] == GOOD:
                    seen_good.add(name)
                    oldest[name] = max(oldest[name], tag["age_ms"])
                elif name in seen_good:
                    oldest[name] = -1
            time.sleep(0.005)
        return oldest

    def failed_tries(self):
        return sum(failed_of(each) for each in self.devices().values())

    def all_good(self, names):
        devices = self.devices()
        return all(name in devices and devices[name]["tags"][0]["quality"] == GOOD for name in names)

    def check(self, living, dead):
        names = [f"unit{each}" for each in living]
        client = self.cell.start("modbus-client")
        self.assertTrue(eventually(lambda: self.all_good(names), PATIENCE_S), client.output())
        client.wait_for("on 1 connection")
        gone = f"unit{dead}"
        self.assertTrue(eventually(lambda: self.devices()[gone]["timeouts"] >= 3, PATIENCE_S))
        before = self.devices()
        oldest = self.watch(names)
        after = self.devices()
        device = after[gone]
        tries = device["timeouts"] - before[gone]["timeouts"]
        self.assertLess(device["tags"][0]["quality"], 64)
        self.assertFalse(device["online"])
        # A try costs the others one timeout; there are few of them: the pauses grow.
        print(f"{type(self).__name__}: oldest values of {SETTLED_S} s: {oldest} ms; {tries} tries of {gone}")
        for name in names:
            self.assertGreaterEqual(oldest[name], 0, "a dead unit is no reason for another's quality")
            # Behind each try everybody else has his turn.
            self.assertGreaterEqual(after[name]["requests"] - before[name]["requests"], tries)
        self.assertLessEqual(tries, 4)

    def test_pymodbus(self):
        self.make(units_of(1, 2, 3, 4))
        self.start_plc(1, 2, 3)
        self.check([1, 2, 3], 4)

    def test_modbus_serial_with_units_that_die_and_return(self):
        self.make(units_of(1, 2, 3, 4))
        slaves = self.start_slave(["node", HERE / "units.mjs", self.line.slave, 1, 2, 3, 4], "ready", stdin=subprocess.PIPE)

        def tell(word, unit):
            slaves.process.stdin.write(f"{word} {unit}\n".encode())
            slaves.process.stdin.flush()
        tell("silence", 4)
        self.check([1, 2, 3], 4)
        for unit in (1, 2, 3):
            self.assertEqual(self.tag(f"unit{unit}", f"level{unit}")["value"], 100 * unit)
        tell("speak", 4)
        slaves.wait_for("speak 4")
        failed = self.devices()["unit4"]["timeouts"]
        self.assertTrue(eventually(lambda: self.all_good(["unit4"]), PATIENCE_S, 0.005))
        # The try that may have been under way, and one that the slave was too slow for.
        self.assertLessEqual(self.devices()["unit4"]["timeouts"], failed + 2)
        # The whole line falls silent, as when its cable is pulled behind the adapter, and comes back.
        for unit in (1, 2, 3, 4):
            tell("silence", unit)
        names = [f"unit{unit}" for unit in (1, 2, 3, 4)]
        self.assertTrue(eventually(lambda: not any(each["online"] for each in self.devices().values()), PATIENCE_S))
        time.sleep(4)
        spoken = slaves.output().count("speak 4")
        for unit in (1, 2, 3, 4):
            tell("speak", unit)
        self.assertTrue(eventually(lambda: slaves.output().count("speak 4") > spoken, PATIENCE_S))
        begin, failed = time.monotonic(), self.failed_tries()
        self.assertTrue(eventually(lambda: self.all_good(names), PATIENCE_S, 0.005))
        print(f"a line of 4 units that was silent is back after {time.monotonic() - begin:.2f} s")
        # The first who answers has all others asked: of each the try that may have been under way, and one that the slave was too slow for.
        self.assertLessEqual(self.failed_tries() - failed, 2 * len(names))

    def test_our_own_server(self):
        self.make(units_of(17, 18))
        served = Cell(f"""\
[clock]
mode = "real"
[plant]
kind = "none"
[modbus.server]
enabled = true
[[modbus.server.line]]
device = "{self.line.slave}"
unit = 17
parity = "none"
stop_bits = 1
[[modbus.server.client]]
address = "{self.line.slave}"
read = ["all"]
""", name=f"served-{os.getpid()}")
        self.addCleanup(served.__exit__)
        source, image = served.folder / "press.st", served.folder / "press.swb"
        source.write_text(PROGRAM, encoding="utf-8")
        self.assertEqual(stepwright("compile", source, "-o", image).returncode, 0)
        served.start_runtime()
        self.assertEqual(stepwright("download", "--config", served.config, image, "--replace").returncode, 0)
        self.assertEqual(stepwright("start", "--config", served.config).returncode, 0)
        served.start("modbus-server").wait_for("serves the program")
        self.check([17], 18)


class Breaks(OnALine):
    def start_all(self, loss):
        self.make(BREAKING.replace("LOSS", loss), PROGRAM)
        self.plc = self.start_plc(1)
        self.client = self.cell.start("modbus-client")
        self.assertTrue(eventually(lambda: (self.tag("plc", "half") or {}).get("quality") == GOOD, PATIENCE_S), self.client.output())
        self.runtime = self.cell.start("runtime")
        self.runtime.wait_for("listens on")
        self.assertTrue(eventually(lambda: (self.tag("plc", "half") or {}).get("value", 0) > 0, PATIENCE_S), self.client.output())

    def fresh(self, since):
        """The slave's answer to something that was written after that instant has come."""
        tag = self.tag("plc", "half")
        if tag["quality"] != GOOD or tag["value"] == self.mark or tag["age_ms"] / 1e3 > time.monotonic() - since:
            return False
        return True

    def test_a_line_that_breaks_is_back_with_the_next_try_each_time(self):
        self.start_all("hold")
        dice = random.Random(5)
        times, most = [], 0
        for number in range(BREAKS):
            time.sleep(dice.uniform(0, 0.1))
            self.line.cut(dice.choice([signal.SIGKILL, signal.SIGTERM]))
            time.sleep(dice.choice([0, dice.uniform(0, 0.05), dice.uniform(0, 0.5)]))
            self.mark = self.tag("plc", "half")["value"]
            self.line.mend()
            begin, failed = time.monotonic(), self.devices()["plc"]["timeouts"]
            self.assertTrue(eventually(lambda: self.fresh(begin), PATIENCE_S, 0.002), f"break {number}\n{self.client.output()}")
            times.append(time.monotonic() - begin)
            most = max(most, self.devices()["plc"]["timeouts"] - failed)
        times.sort()
        print(f"{len(times)} breaks: back after p50 {times[len(times) // 2] * 1e3:.0f} ms, "
              f"p99 {times[len(times) * 99 // 100] * 1e3:.0f} ms, max {times[-1] * 1e3:.0f} ms, at most {most} tries failed")
        # What the broken line has garbled, and its repetition.
        self.assertLessEqual(most, 2)

    def test_a_lost_device_gives_its_value_on_loss_and_says_what_it_is_worth(self):
        self.start_all("value")
        self.assertEqual(self.value("worst"), 0)
        self.line.cut()
        self.assertTrue(eventually(lambda: self.value("half") == -7, PATIENCE_S))
        self.assertEqual(self.value("quality"), 8)  # bad: not connected
        self.line.mend()
        self.assertTrue(eventually(lambda: self.value("half") >= 0, PATIENCE_S))
        self.assertEqual(self.value("quality"), GOOD)
        self.assertEqual(self.value("worst"), -7)
        self.assertEqual(self.value("least"), 8)

    def test_a_device_without_which_the_program_must_not_run_gets_its_safe_outputs(self):
        self.start_all("safe")
        self.line.cut()
        self.runtime.wait_for("does not answer")
        self.line.mend()
        # 14 is written to it, and half of that comes back.
        self.assertTrue(eventually(lambda: self.tag("plc", "half")["value"] == 7 and self.tag("plc", "half")["quality"] == GOOD, PATIENCE_S),
                        self.client.output())
        time.sleep(0.5)
        self.assertEqual(self.tag("plc", "half")["value"], 7)  # a device that answers again starts nothing

    def test_a_client_that_was_killed_finds_the_line_as_it_left_it(self):
        self.start_all("hold")
        self.client.end(signal.SIGKILL)
        again = self.cell.start("modbus-client")
        self.assertTrue(eventually(lambda: (self.tag("plc", "half") or {}).get("quality") == GOOD, PATIENCE_S), again.output())

    def test_a_path_that_leads_to_another_line_is_followed(self):
        self.start_all("hold")
        other = BreakableLine(self.cell.folder, "other")
        self.addCleanup(other.close)
        self.start_plc(1, line=other)
        # As a link of udev after an adapter was exchanged, while something still holds the old device open.
        self.line.master.unlink()
        self.line.master.symlink_to(other.master.resolve())
        self.assertEqual(self.tag("plc", "half")["quality"], GOOD)  # nobody leaves a line that answers
        begin = time.monotonic()
        self.plc.end(signal.SIGKILL)
        self.mark = None
        self.assertTrue(eventually(lambda: not self.devices()["plc"]["online"], PATIENCE_S), self.client.output())
        self.assertTrue(eventually(lambda: self.fresh(begin) and self.devices()["plc"]["online"], PATIENCE_S), self.client.output())

    def test_a_second_client_of_another_cell_does_not_get_the_line(self):
        self.start_all("hold")
        other = Cell((HEAD + units_of(1)).replace("LINE", str(self.line.master)), name=f"other-{os.getpid()}")
        self.addCleanup(other.__exit__)
        other.start("modbus-client").wait_for("the line is in use")
        self.assertEqual(self.tag("plc", "half")["quality"], GOOD)


if __name__ == "__main__":
    unittest.main()
