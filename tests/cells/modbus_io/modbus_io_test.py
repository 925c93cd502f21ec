"""Devices over Modbus as the I/O of a cell: runtime, guard and client as processes, and PLCs of pymodbus as the field."""

import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import time
import unittest

from namespaces import need_network_of_its_own
from processes import PATIENCE_S, Cell, Process, eventually, figures_of, stepwright

HERE = pathlib.Path(__file__).parent
PORT = 1502

# The process of the PLC halves what it is given, so the loop ends at 1000, wherever it begins: the first level may be that of
# the safe state's setpoint.
PROGRAM = """\
PROGRAM Main
  VAR
    level AT %IW0 : INT;
    started AT %IX2.0 : BOOL;
    quality AT %IB4 : USINT;
    setpoint AT %QW0 : INT;
    pump AT %QX2.0 : BOOL;
    scans : DINT;
  END_VAR
  pump := TRUE;
  IF started AND quality = 192 AND level < 500 THEN
    setpoint := level / 10 * 20 + 20;
  END_IF;
  scans := scans + 1;
END_PROGRAM

CONFIGURATION Press
  RESOURCE Cpu ON Plc
    TASK Fast(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM main WITH Fast : Main;
  END_RESOURCE
END_CONFIGURATION
"""

CELL = """\
[clock]
mode = "real"
[image]
input_bytes = 8
output_bytes = 8
[io]
kind = "modbus"
[guard]
timeout_ms = 5_000
[modbus.client]
holder_timeout_ms = 60_000
[safe_state.lost_io]
"%QW0" = { value = 7 }
[safe_state.killed]
"%QW0" = { value = 9 }
[[modbus.device]]
name = "plc"
PLACE
loss_after_ms = 400
online = "%IX2.1"
[[modbus.device.group]]
period_ms = 20
tags = [
  { name = "level", address = "%IW0", input = 0, quality = "%IB4", age = "%IW3" },
  { address = "%IX2.0", discrete = 0 },
  { address = "%QW0", holding = 0 },
  { address = "%QX2.0", coil = 0 },
]
"""


def listens(port):
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


class Plant:
    """A cell with its PLC."""

    def __init__(self, case, place=f'host = "127.0.0.1"\nport = {PORT}', peer=("tcp", PORT, 1)):
        self.cell = Cell(CELL.replace("PLACE", place))
        case.addCleanup(self.cell.__exit__)
        case.addCleanup(lambda: pathlib.Path(f"/dev/shm/stepwright-io-{self.cell.name}").unlink(missing_ok=True))
        self.peer = peer
        self.plc = None
        source = self.cell.folder / "press.st"
        source.write_text(PROGRAM, encoding="utf-8")
        self.image = self.cell.folder / "press.swb"
        done = stepwright("compile", source, "-o", self.image)
        case.assertEqual(done.returncode, 0, done.stderr)

    def start_plc(self):
        self.plc = Process(["/usr/bin/python3", HERE / "pymodbus_plc.py", *self.peer], self.cell.folder / "plc.log")
        self.cell.processes.append(self.plc)
        self.plc.wait_for("PLC at")
        if self.peer[0] == "tcp":  # it says so before it listens
            assert eventually(lambda: listens(PORT) or not self.plc.running()), self.plc.output()
            assert self.plc.running(), self.plc.output()

    def command(self, *words):
        name, *rest = words
        return stepwright(name, "--config", self.cell.config, *rest)

    def losses(self):
        """How often the runtime has stopped its program because the devices were lost."""
        return self.runtime.output().count("the I/O driver does not answer")

    def start_again(self):
        """As soon as the runtime itself says that its I/O answers."""
        def accepted():
            told = self.command("start")
            assert told.returncode == 0 or "R0008" in told.stderr, told.stderr
            return told.returncode == 0

        self.known_losses = self.losses()
        assert eventually(accepted, pause_s=0.1), self.log()

    def lost_again(self):
        """A client that a busy machine keeps from running for 250 ms is lost, rightly: an operator starts again."""
        if self.losses() > self.known_losses:
            self.start_again()
        return False

    def log(self):
        return f"{self.runtime.output()}\n{self.client.output()}"

    def value(self, name):
        told = self.command("snapshot", name, "--json", "-")
        return told.stdout

    def status(self):
        file = self.cell.folder / "status.json"
        done = self.command("modbus-client", "--status", "--json", file)
        assert done.returncode == 0, done.stderr
        return json.loads(file.read_text(encoding="utf-8"))["devices"][0]

    def field(self, table="4", count=1):
        """What an independent master reads from the PLC: holding registers (4) or coils (0)."""
        done = subprocess.run(["mbpoll", "-m", "tcp", "-p", str(PORT), "-a", "1", "-t", table, "-r", "1", "-c", str(count),
                               "-1", "-o", "10", "127.0.0.1"], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        found = re.search(r"\[1\]:\s+(-?\d+)", done.stdout)
        return int(found.group(1)) if found else None

    def state(self):
        return self.cell.metrics()

    def start_all(self):
        self.start_plc()
        self.client = self.cell.start("modbus-client")
        self.client.wait_for("all devices that the program needs are there")
        self.runtime = self.cell.start_runtime()
        self.run(self.image)

    def run(self, image):
        done = self.command("download", image, "--replace")
        assert done.returncode == 0, done.stderr
        self.start_again()

    def tag(self, name):
        return next(each for each in self.status()["tags"] if each["name"] == name)


class ModbusIo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        need_network_of_its_own()

    def test_outputs_arrive_and_inputs_come_back(self):
        plant = Plant(self)
        plant.start_all()
        self.assertTrue(eventually(lambda: plant.field() == 1000), plant.client.output())
        self.assertTrue(eventually(lambda: plant.tag("level")["value"] == 500))
        self.assertTrue(eventually(lambda: plant.tag("level")["age_ms"] < 1_000))
        level = plant.tag("level")
        self.assertEqual(level["quality"], 192)
        self.assertRegex(level["time"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$")
        self.assertEqual(plant.field("0"), 1)
        told = plant.command("modbus-client", "--status")
        self.assertIn("plc", told.stdout)
        self.assertIn("online", told.stdout)
        figures = plant.command("modbus-client", "--metrics").stdout
        self.assertIn(f'stepwright_modbus_device_online{{cell="{plant.cell.name}",device="plc"}} 1', figures)
        maps = pathlib.Path(f"/proc/{plant.runtime.pid}/maps").read_text(encoding="ascii")
        self.assertNotIn("libmodbus", maps)

    def test_its_figures_are_served_over_http(self):
        plant = Plant(self)
        plant.cell.config.write_text(plant.cell.config.read_text(encoding="utf-8") +
                                     "[modbus.client.metrics]\nport = 0\n", encoding="utf-8")
        plant.start_all()
        fetch = figures_of(plant.client)
        device = (("cell", plant.cell.name), ("device", "plc"))

        def figure(name, *labels):
            return fetch()[(f"stepwright_modbus_{name}", (*device, *labels))]

        self.assertTrue(eventually(lambda: figure("polls_total", ("group", "group1")) > 10))
        self.assertEqual(figure("device_online"), 1)
        self.assertEqual(figure("device_lost"), 0)
        self.assertEqual(figure("poll_period_seconds", ("group", "group1")), 0.02)
        self.assertGreater(figure("poll_cycle_seconds", ("group", "group1"), ("quantile", "0.5")), 0.005)
        self.assertGreater(figure("answer_seconds", ("quantile", "0.99")), 0)
        self.assertTrue(eventually(lambda: figure("tags", ("quality", "good")) == 4), fetch())
        self.assertEqual(figure("tag_quality", ("tag", "level"), ("address", "%IW0")), 192)
        losses = figure("connection_losses_total")
        plant.plc.end(signal.SIGKILL)
        self.assertTrue(eventually(lambda: figure("device_online") == 0 and figure("device_lost") == 1))
        self.assertEqual(figure("tags", ("quality", "good")), 0)
        plant.start_plc()
        self.assertTrue(eventually(lambda: figure("device_online") == 1))
        self.assertGreater(figure("connection_losses_total"), losses)
        # The command asks the same process.
        told = plant.command("modbus-client", "--metrics").stdout
        self.assertIn("stepwright_modbus_polls_total{", told)
        self.assertEqual(plant.client.end(), 0)

    def test_a_lost_plc_stops_the_program_and_comes_back_to_its_safe_outputs(self):
        plant = Plant(self)
        plant.start_all()
        self.assertTrue(eventually(lambda: plant.field() == 1000), plant.client.output())
        plant.plc.end(signal.SIGKILL)
        self.assertTrue(eventually(lambda: "does not answer" in plant.runtime.output()), plant.runtime.output())
        status = plant.status()
        self.assertTrue(status["lost"])
        self.assertFalse(status["online"])
        self.assertLess(plant.tag("level")["quality"], 64)
        plant.start_plc()  # it has forgotten everything
        self.assertTrue(eventually(lambda: plant.field() == 7), plant.client.output())
        self.assertTrue(eventually(lambda: not plant.status()["lost"]))
        self.assertEqual(plant.field(), 7)  # the program is not started by a device that answers again
        plant.start_again()
        self.assertTrue(eventually(lambda: plant.field() == 1000 or plant.lost_again()), plant.log())

    def test_where_the_cell_says_so_the_program_is_started_again_unless_somebody_stops_it(self):
        plant = Plant(self)
        text = plant.cell.config.read_text(encoding="utf-8")
        plant.cell.config.write_text(text.replace('kind = "modbus"', 'kind = "modbus"\nrestart = "auto"\n'
                                                  'restart_after_s = 0.3\nrestart_limit = 100'), encoding="utf-8")
        plant.start_all()
        self.assertTrue(eventually(lambda: plant.field() == 1000), plant.client.output())
        plant.plc.end(signal.SIGKILL)
        plant.runtime.wait_for(r"device 'plc' \(127\.0\.0\.1:\d+\): ")
        self.assertTrue(eventually(lambda: plant.cell.figure("stepwright_warnings") == 1))
        plant.start_plc()
        plant.runtime.wait_for(r"the program is started again \(\d+ of 100 within an hour\)")
        self.assertTrue(eventually(lambda: plant.field() == 1000), plant.log())
        # A stop is a stop, also of a program that waits for its devices.
        losses = plant.losses()
        plant.plc.end(signal.SIGKILL)
        self.assertTrue(eventually(lambda: plant.losses() > losses), plant.log())
        self.assertEqual(plant.command("stop").returncode, 0)
        starts = plant.runtime.output().count("started again")
        plant.start_plc()
        self.assertTrue(eventually(lambda: plant.field() == 7), plant.client.output())
        self.assertTrue(eventually(lambda: plant.runtime.output().count("the I/O is there again") == 2), plant.log())
        time.sleep(1)  # three times as long as a start would have taken
        self.assertEqual(plant.runtime.output().count("started again"), starts)
        self.assertEqual(plant.field(), 7)

    def test_a_start_is_refused_for_as_long_as_the_devices_are_lost(self):
        plant = Plant(self)
        plant.start_all()
        self.assertTrue(eventually(lambda: plant.field() == 1000), plant.client.output())
        plant.plc.end(signal.SIGKILL)
        self.assertTrue(eventually(lambda: "does not answer" in plant.runtime.output()), plant.runtime.output())
        losses = plant.losses()
        for _ in range(3):
            told = plant.command("start")
            self.assertEqual(told.returncode, 1)
            self.assertIn("R0008", told.stderr)
        self.assertEqual(plant.losses(), losses)  # what was refused has not begun
        plant.start_plc()
        plant.start_again()
        self.assertTrue(eventually(lambda: plant.field() == 1000 or plant.lost_again()), plant.log())

    def test_a_killed_runtime_leaves_the_devices_to_its_guard(self):
        plant = Plant(self)
        plant.start_all()
        self.assertTrue(eventually(lambda: plant.field() == 1000))
        plant.runtime.end(signal.SIGKILL)
        self.assertTrue(eventually(lambda: plant.field() == 9), plant.client.output())
        self.assertEqual(plant.field("0"), 0)
        self.assertNotIn("neither runtime nor guard", plant.client.output())
        plant.runtime = plant.cell.start_runtime()
        plant.run(plant.image)

        # Devices that are lost while the memory changes hands stop the program, and an operator starts it again.
        def runs():
            return plant.field() == 1000 or (plant.command("start").returncode == 0 and plant.field() == 1000)

        self.assertTrue(eventually(runs, pause_s=0.5),
                        f"{plant.runtime.output()}\n{plant.client.output()}\n{plant.status()}")

    def test_without_runtime_and_guard_the_client_drives_the_safe_outputs(self):
        plant = Plant(self)
        plant.cell.config.write_text(plant.cell.config.read_text(encoding="utf-8").replace(
            "[guard]\n", "[guard]\nenabled = false\n").replace("holder_timeout_ms = 60_000\n", ""), encoding="utf-8")
        plant.start_all()
        self.assertTrue(eventually(lambda: plant.field() == 1000))
        plant.runtime.end(signal.SIGKILL)
        self.assertTrue(eventually(lambda: plant.field() == 9), plant.client.output())
        plant.client.wait_for("neither runtime nor guard")

    def test_the_end_of_the_client_is_lost_io_on_both_sides(self):
        plant = Plant(self)
        plant.start_all()
        self.assertTrue(eventually(lambda: plant.field() == 1000))
        self.assertEqual(plant.client.end(), 0)
        self.assertEqual(plant.field(), 7)
        self.assertTrue(eventually(lambda: "does not answer" in plant.runtime.output()), plant.runtime.output())
        asked = plant.command("modbus-client", "--status")
        self.assertEqual(asked.returncode, 5)
        self.assertIn("R0127", asked.stderr)

    def test_a_client_that_is_killed_frozen_or_restarted_is_lost_io_until_a_start(self):
        plant = Plant(self)
        plant.start_all()
        for number in (signal.SIGKILL, signal.SIGSTOP, signal.SIGTERM):
            with self.subTest(number=number):
                self.assertTrue(eventually(lambda: plant.field() == 1000 or plant.lost_again()), plant.log())
                losses = plant.losses()
                if number == signal.SIGSTOP:
                    os.kill(plant.client.pid, number)
                else:
                    plant.client.end(number)
                self.assertTrue(eventually(lambda: plant.losses() > losses), plant.log())
                if number == signal.SIGSTOP:
                    os.kill(plant.client.pid, signal.SIGCONT)
                else:
                    plant.client = plant.cell.start("modbus-client")
                self.assertTrue(eventually(lambda: plant.field() == 7), plant.log())
                plant.client.wait_for("Modbus client of")
                self.assertTrue(eventually(lambda: not plant.status()["lost"]), plant.log())
                self.assertEqual(plant.field(), 7)  # who is back does not start the program
                plant.start_again()

    def test_an_autostart_waits_for_its_devices(self):
        plant = Plant(self)
        plant.cell.config.write_text(plant.cell.config.read_text(encoding="utf-8") +
                                     f'[runtime]\nprogram = "{plant.image}"\nautostart = true\n', encoding="utf-8")
        runtime = plant.cell.start("runtime")
        runtime.wait_for("waits for its devices")
        plant.cell.start("modbus-client")
        plant.start_plc()
        runtime.wait_for("listens on")
        self.assertTrue(eventually(lambda: plant.field() == 1000), runtime.output())

    def test_a_second_client_and_a_cell_without_devices_are_refused(self):
        plant = Plant(self)
        plant.start_all()
        second = plant.cell.start("modbus-client")
        self.assertEqual(second.wait(), 1)
        self.assertIn("R0044", second.output())
        other = Cell('[io]\nkind = "shared_memory"\n\n[clock]\nmode = "real"\n', name="no-devices")
        self.addCleanup(other.__exit__)
        refused = other.start("modbus-client")
        self.assertEqual(refused.wait(), 1)
        self.assertIn("C0526", refused.output())


if __name__ == "__main__":
    unittest.main()
