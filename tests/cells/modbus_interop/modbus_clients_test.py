"""Clients that others wrote against a runtime that stepwright modbus-server serves: mbpoll, pymodbus, npm's jsmodbus and
modbus-serial, libmodbus, over TCP and over a serial line. tshark looks at every frame: none may be malformed, none may
be worth a warning."""

import json
import pathlib
import re
import subprocess
import unittest

from lines import TappedLine
from namespaces import need_network_of_its_own
from processes import PATIENCE_S, TESTS, Process, eventually
from served import EVERYBODY, PORT, Served, temporary_folder

HERE = pathlib.Path(__file__).parent
CLIENTS = {
    "pymodbus": ["/usr/bin/python3", HERE / "peer_client.py"],
    "jsmodbus": ["node", HERE / "peer_client.mjs", "jsmodbus"],
    "modbus-serial": ["node", HERE / "peer_client.mjs", "modbus-serial"],
}
ALL = ["FC15", "FC5", "FC1", "FC2", "FC16", "FC6", "FC3", "FC4", "FC22", "FC22-value", "FC23", "FC43", "beyond", "most"]
# What a client offers must work, all of it. Over a serial line modbus-serial does not offer all.
RARE = ["FC22", "FC22-value", "FC23"]
NOT_OFFERED = {("jsmodbus", "tcp"): RARE, ("jsmodbus", "rtu"): RARE, ("modbus-serial", "rtu"): RARE}


def expected(name, kind):
    offered = [each for each in ALL if each not in NOT_OFFERED.get((name, kind), [])]
    return {each: "exception 2" if each == "beyond" else "ok" for each in offered}


def mbpoll(mode, *arguments):
    """mbpoll, once; the values that it prints, by reference."""
    done = subprocess.run(["mbpoll", "-0", "-1", "-a", "1", "-o", "10", *mode, *map(str, arguments)], capture_output=True,
                          text=True, timeout=PATIENCE_S, check=False)
    return done, {int(at): value for at, value in re.findall(r"^\[(\d+)\]:\s+(\S+)", done.stdout, re.M)}


# Warnings and errors: a wrong CRC is a warning there.
WARNING = 0x600000
WRONG = f"_ws.malformed || _ws.expert.severity >= {WARNING}"


def look(capture, dissector, display_filter):
    """Summaries of the frames of a capture that the filter finds. Order and gaps of TCP segments are the kernel's and the
    capture's, and are not looked at."""
    done = subprocess.run(["tshark", "-r", capture, "-o", f"mbtcp.tcp.port:{PORT}", "-d", dissector, "-o",
                           "tcp.analyze_sequence_numbers:FALSE", "-o", "mbrtu.crc_verification:TRUE", "-Y", display_filter],
                          capture_output=True, text=True, timeout=PATIENCE_S, check=True)
    return done.stdout.splitlines()


class Capture:
    """What goes over the loopback while it lives."""

    def __init__(self, folder):
        self.file = folder / "capture.pcapng"
        self.process = Process(["tshark", "-q", "-i", "lo", "-f", f"tcp port {PORT}", "-w", self.file], folder / "tshark.log")
        self.process.wait_for("Capture started")  # "Capturing on" comes before it does

    def close(self):
        self.process.end(2)



class Clients(unittest.TestCase):
    def setUp(self):
        need_network_of_its_own()
        self.folder = temporary_folder(self)

    def serve(self, more=EVERYBODY):
        cell = Served(more)
        self.addCleanup(cell.__exit__)
        cell.start_all()
        cell.answers()

    def run_client(self, name, kind, where):
        done = subprocess.run([*CLIENTS[name], kind, str(where)], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(json.loads(done.stdout), expected(name, kind))

    def run_mbpoll(self, mode, where):
        def poll(*arguments):
            done, values = mbpoll(mode, *arguments)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            return values
        poll("-t", 0, "-r", 40, where, 1, 0, 1)  # FC 15
        poll("-t", 0, "-r", 43, where, 1)  # FC 5
        self.assertEqual(poll("-t", 0, "-r", 40, "-c", 4, where), {40: "1", 41: "0", 42: "1", 43: "1"})
        self.assertEqual(poll("-t", 1, "-r", 9, "-c", 4, where), {9: "1", 10: "0", 11: "0", 12: "1"})
        poll("-t", 4, "-r", 50, where, 1000, 2000)  # FC 16
        poll("-t", 4, "-r", 52, where, 3000)  # FC 6
        self.assertEqual(poll("-t", 4, "-r", 50, "-c", 3, where), {50: "1000", 51: "2000", 52: "3000"})
        self.assertEqual(poll("-t", 3, "-r", 20, "-c", 2, where), {20: "67", 21: "70"})
        done, _ = mbpoll(mode, "-t", 4, "-r", 60000, where)
        self.assertIn("Illegal data address", done.stdout + done.stderr)

    def test_tcp(self):
        self.serve()
        capture = Capture(self.folder)
        self.addCleanup(capture.close)
        self.run_mbpoll(["-m", "tcp", "-p", str(PORT)], "127.0.0.1")
        for name in CLIENTS:
            with self.subTest(name):
                self.run_client(name, "tcp", PORT)
        master = subprocess.run([TESTS / "modbus_interop_master", "tcp", str(PORT)], capture_output=True, text=True, timeout=PATIENCE_S,
                                check=False)
        self.assertEqual(master.returncode, 0, master.stdout + master.stderr)
        self.assertTrue(eventually(lambda: capture.file.exists() and capture.file.stat().st_size > 1000))
        capture.close()
        dissector = f"tcp.port=={PORT},mbtcp"
        frames = look(capture.file, dissector, "mbtcp")
        self.assertGreater(len(frames), 60, "the capture has too little in it")
        functions = {int(each) for each in re.findall(r"Func:\s+(\d+)", "\n".join(frames))}
        self.assertLessEqual({1, 2, 3, 4, 5, 6, 15, 16, 22, 23, 43}, functions)
        self.assertEqual(look(capture.file, dissector, WRONG), [])

    def test_rtu(self):
        line = TappedLine()
        self.addCleanup(line.close)
        self.serve(EVERYBODY + EVERYBODY.replace("0.0.0.0/0", line.slave) +
                   f'[[modbus.server.line]]\ndevice = "{line.slave}"\nparity = "none"\nunit = 1\n')
        self.run_mbpoll(["-m", "rtu", "-b", "19200", "-P", "none"], line.master)
        for name in CLIENTS:
            with self.subTest(name):
                self.run_client(name, "rtu", line.master)
        master = subprocess.run([TESTS / "modbus_interop_master", "rtu", line.master], capture_output=True, text=True, timeout=PATIENCE_S,
                                check=False)
        self.assertEqual(master.returncode, 0, master.stdout + master.stderr)
        line.close()
        capture = self.folder / "line.pcap"
        line.write_capture(capture, PORT)
        dissector = f"udp.port=={PORT},mbrtu"
        self.assertGreater(len(look(capture, dissector, "mbrtu")), 100)
        self.assertEqual(look(capture, dissector, WRONG), [])
        # The filter finds what is wrong: a byte of one frame is another.
        from_master, frame = line.frames[-1]
        line.frames[-1] = (from_master, frame[:-1] + bytes([frame[-1] ^ 1]))
        line.write_capture(capture, PORT)
        self.assertEqual(len(look(capture, dissector, WRONG)), 1)


if __name__ == "__main__":
    unittest.main()
