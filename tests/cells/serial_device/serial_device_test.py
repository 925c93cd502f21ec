"""stepwright modbus-client and modbus-server on serial ports of a kernel's own driver: what they set on the port, that nobody
else speaks there, and what happens when the port is pulled out and plugged in again. Peers: pymodbus and mbpoll."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import termios
import time
import unittest

from guest import Guest, PATIENCE_S
from lines import Line
from processes import Process, eventually, stepwright

HERE = pathlib.Path(__file__).parent
PLC = HERE.parent / "modbus_io" / "pymodbus_plc.py"
# COM2 of a PC, and a card with a 16550A that can be pulled out while the machine runs.
COM2, COM2_LINE_CONTROL = "/dev/ttyS1", 0x2F8 + 3
CARD = "/dev/ttyS2"
CARD_DEVICE = "pci-serial,id=card,chardev=card"

PROGRAM = """\
PROGRAM Main
  VAR
    level AT %IW0 : INT;
    setpoint AT %QW0 : INT;
  END_VAR
  IF level < 500 THEN
    setpoint := level * 2 + 20;
  END_IF;
END_PROGRAM

CONFIGURATION Press
  RESOURCE Cpu ON Plc
    TASK Fast(INTERVAL := T#20ms, PRIORITY := 1);
    PROGRAM main WITH Fast : Main;
  END_RESOURCE
END_CONFIGURATION
"""
CELL = """\
[cell]
name = "NAME"
state_dir = "/tmp/NAME"
[clock]
mode = "real"
[image]
input_bytes = 8
output_bytes = 8
[guard]
timeout_ms = 60000
"""
CLIENT = CELL + """\
[io]
kind = "modbus"
[runtime]
program = "/cell/press.swb"
autostart = true
[modbus.client]
silence_ms = 60000
holder_timeout_ms = 60000
[modbus.lines."DEVICE"]
SETTINGS
[[modbus.device]]
name = "plc"
line = "DEVICE"
timeout_ms = 2000
loss_after_ms = 60000
[[modbus.device.group]]
period_ms = 50
tags = [
  { name = "level", address = "%IW0", input = 0 },
  { address = "%QW0", holding = 0 },
]
"""
SERVER = CELL + """\
[runtime]
program = "/cell/press.swb"
autostart = true
[plant]
kind = "none"
[modbus.server]
enabled = true
port = 1502
writable = true
[[modbus.server.line]]
device = "DEVICE"
unit = 17
baud = 38_400
parity = "even"
[[modbus.server.client]]
address = "DEVICE"
read = ["all"]
write = ["all"]
"""
# What the configuration says, what the port's line control register has then (bits 0-1: size, 2: stop bits, 3: parity,
# 4: not odd), and the speed that QEMU sets on the host's end of the line.
FIRST_SETPOINT = 20  # of the program, with the level at 0
COMMANDS = ("runtime", "modbus-client", "modbus-server")
SETTINGS = {
    "e": ('baud = 9600\nparity = "even"', 0x1B, termios.B9600),
    "o": ('baud = 115200\nparity = "odd"\nstop_bits = 2', 0x0F, termios.B115200),
    "n": ('baud = 19200\nparity = "none"\nstop_bits = 2', 0x17, termios.B19200),
}


def of(template, name, device, settings=""):
    return template.replace("NAME", name).replace("DEVICE", device).replace("SETTINGS", settings).encode()


def files():
    made = {"card.toml": of(CLIENT, "card", CARD, SETTINGS["e"][0]), "server.toml": of(SERVER, "server", CARD),
            "second.toml": of(SERVER, "second", COM2)}
    for name, (settings, _, _) in SETTINGS.items():
        made[f"{name}.toml"] = of(CLIENT, name, COM2, settings)
    return made


class SerialDevice(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-guest-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)
        source, image = cls.folder / "press.st", cls.folder / "press.swb"
        source.write_text(PROGRAM, encoding="utf-8")
        done = stepwright("compile", source, "-o", image)
        assert done.returncode == 0, done.stderr
        # An end of each pair is QEMU's, which sets the speed there that the guest sets on its port.
        cls.lines = {name: Line(cls.folder, name) for name in ("com2", "card")}
        options = []
        for name, line in cls.lines.items():
            cls.addClassCleanup(line.close)
            options += ["-chardev", f"serial,id={name},path={line.master}"]
        options += ["-device", "isa-serial,chardev=com2,iobase=0x2f8,irq=3", "-device", CARD_DEVICE]
        users = b"root:x:0:0::/:/bin/sh\nnobody:x:65534:65534::/:/bin/sh\n"
        cls.guest = Guest(cls.folder, [*COMMANDS, "guard"],
                          files() | {"press.swb": image.read_bytes(), "passwd": users}, options)
        cls.addClassCleanup(cls.guest.close)
        cls.guest.say("mkdir -p /etc && cp /cell/passwd /etc && chmod 666 /dev/ttyS*")
        print(f"the guest is up after {cls.guest.boot_s:.1f} s")

    def start_plc(self, name):
        plc = Process(["/usr/bin/python3", PLC, "line", self.lines[name].slave], self.folder / "plc.log")
        self.addCleanup(plc.end)
        plc.wait_for("PLC at")
        return plc

    def tearDown(self):
        for command in COMMANDS:
            self.guest.stop(command)

    def start(self, command, config):
        return self.guest.start(command, f"/cell/{config}.toml")

    def status(self, config):
        code, said = self.guest.run(f"stepwright modbus-client --config /cell/{config}.toml --status")
        return said if code == 0 else ""

    def level(self, config):
        """The tag's value and what it is worth."""
        found = re.search(r"%IW0 +level +(\d+), ([a-z:]+)", self.status(config))
        return (int(found.group(1)), found.group(2)) if found else None

    def wait_for_level(self, config, wanted, patience_s=PATIENCE_S):
        found = eventually(lambda: self.level(config) == wanted, patience_s, 0.05)
        self.assertTrue(found, f"{self.status(config)}\n{self.guest.run('cat /tmp/*.log')[1]}")

    def mbpoll(self, name):
        """What an independent master reads of holding register 0, and not a late answer that nobody waited for."""
        end = os.open(self.lines[name].slave, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        termios.tcflush(end, termios.TCIOFLUSH)
        os.close(end)
        done = subprocess.run(["mbpoll", "-m", "rtu", "-b", "38400", "-P", "even", "-a", "17", "-0", "-r", "0", "-t", "4", "-1",
                               "-o", "0.5", self.lines[name].slave], capture_output=True, text=True, check=False)
        found = re.search(r"\[0\]:\s+(-?\d+)", done.stdout)
        return int(found.group(1)) if found else None

    def open_as_nobody(self):
        """Of a user who may, and is not root."""
        return self.guest.run(f"su nobody -s /bin/sh -c 'true <>{COM2}'")

    def card_is_there(self):
        return self.guest.run(f"stty -F {CARD}")[0] == 0

    def pull_out(self):
        self.guest.ask_monitor("device_del card")
        self.assertTrue(eventually(lambda: not self.card_is_there(), PATIENCE_S, 0.05))
        # The guest lets it go some time after its driver has; before that there is no room for another one.
        self.assertTrue(eventually(lambda: 'id "card"' not in self.guest.ask_monitor("info qtree"), PATIENCE_S, 0.05))

    def plug_in(self):
        said = self.guest.ask_monitor(f"device_add {CARD_DEVICE}")
        self.assertTrue(eventually(self.card_is_there, PATIENCE_S, 0.02), said)
        self.assertIn('id "card"', self.guest.ask_monitor("info qtree"))

    def test_the_client_polls_a_plc_with_the_settings_that_it_was_told(self):
        self.start_plc("com2")
        for config, (_, line_control, speed) in SETTINGS.items():
            with self.subTest(config):
                log = self.start("modbus-client", config)
                runtime = self.start("runtime", config)
                # The program sees what the PLC makes of what it writes: the loop ends at 500.
                self.wait_for_level(config, (500, "good"))
                said = self.guest.ask_monitor(f"i /1xb {COM2_LINE_CONTROL:#x}")
                self.assertEqual(int(re.search(r"= (0x[0-9a-f]+)", said).group(1), 16), line_control, said)
                end = os.open(self.lines["com2"].master, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
                self.addCleanup(os.close, end)
                self.assertEqual(termios.tcgetattr(end)[5], speed)
                low_latency = 1 << 13
                self.assertTrue(int(self.guest.say("cat /sys/class/tty/ttyS1/flags"), 16) & low_latency)
                self.guest.stop("runtime")
                self.guest.stop("modbus-client")
                self.assertNotIn("error", self.guest.say(f"cat {log} {runtime}").lower())
            for command in COMMANDS:  # of one that failed, too
                self.guest.stop(command)

    def test_nobody_else_speaks_on_the_clients_port(self):
        self.start_plc("com2")
        self.start("modbus-client", "e")
        self.assertTrue(eventually(lambda: "online" in self.status("e"), PATIENCE_S, 0.05), self.status("e"))
        code, said = self.open_as_nobody()
        self.assertNotEqual(code, 0)
        self.assertIn("busy", said)
        second = self.start("modbus-server", "second")
        self.guest.wait_for(second, "R0112")
        self.assertIn("online", self.status("e"))
        self.guest.stop("modbus-client")
        # Now the server takes it, and leaves it to everybody in the end.
        self.assertTrue(eventually(lambda: self.open_as_nobody()[0] != 0, PATIENCE_S, 0.05))
        self.guest.stop("modbus-server")
        self.assertEqual(self.open_as_nobody()[0], 0)

    def test_the_client_comes_back_with_its_port(self):
        self.start_plc("card")
        self.start("modbus-client", "card")
        self.assertTrue(eventually(lambda: "online" in self.status("card"), PATIENCE_S, 0.05), self.status("card"))
        self.pull_out()
        self.assertTrue(eventually(lambda: "offline" in self.status("card"), PATIENCE_S, 0.05))
        self.assertTrue(eventually(lambda: "bad" in (self.level("card") or ("", ""))[1], PATIENCE_S, 0.05), self.status("card"))
        self.plug_in()
        begin = time.monotonic()
        self.assertTrue(eventually(lambda: "offline" not in self.status("card"), PATIENCE_S, 0.02))
        print(f"the client answers {time.monotonic() - begin:.2f} s after its port is back")

    def test_the_server_comes_back_with_its_port(self):
        self.start("runtime", "server")
        log = self.start("modbus-server", "server")
        self.assertTrue(eventually(lambda: self.mbpoll("card") == FIRST_SETPOINT, PATIENCE_S), self.guest.run(f"cat {log}")[1])
        self.pull_out()
        self.assertTrue(eventually(lambda: self.mbpoll("card") is None, PATIENCE_S))
        self.guest.wait_for(log, "R0111")
        self.plug_in()
        begin = time.monotonic()
        self.assertTrue(eventually(lambda: self.mbpoll("card") == FIRST_SETPOINT, PATIENCE_S), self.guest.run(f"cat {log}")[1])
        print(f"the server answers {time.monotonic() - begin:.2f} s after its port is back")


if __name__ == "__main__":
    unittest.main()
