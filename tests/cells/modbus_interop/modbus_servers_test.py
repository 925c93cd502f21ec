"""Our master polls slaves that others wrote: pymodbus, npm's jsmodbus and modbus-serial, over TCP and over a serial line."""

import pathlib
import shutil
import subprocess
import tempfile
import unittest

from lines import Line
from namespaces import need_network_of_its_own
from processes import PATIENCE_S, TESTS, Process

HERE = pathlib.Path(__file__).parent
PORT = 1502
SERVERS = {
    "pymodbus": ["/usr/bin/python3", HERE / "peer_server.py"],
    "jsmodbus": ["node", HERE / "peer_server.mjs", "jsmodbus"],
    "modbus-serial": ["node", HERE / "peer_server.mjs", "modbus-serial"],
}
ALL = ["FC15", "FC5", "FC1", "FC2", "FC16", "FC6", "FC3", "FC4", "FC22", "FC22-value", "FC23", "beyond", "most"]
ALL_OK = dict.fromkeys(ALL, "ok") | {"beyond": "exception 2"}
# What a peer does not offer, or does in its own way. jsmodbus answers a range that it does not have with no registers and
# no exception, and a function that it does not know with nothing.
SILENT_S = 1
NO_ANSWER = {"beyond": "the answer is not one to this request", "FC22": "no answer within the timeout",
             "FC23": "no answer within the timeout"}
REFUSED = {"FC22": "exception 1", "FC23": "exception 1"}
EXPECTED = {"pymodbus": ALL_OK, "jsmodbus": ALL_OK | NO_ANSWER, "modbus-serial": ALL_OK | REFUSED}
for name in ("jsmodbus", "modbus-serial"):
    del EXPECTED[name]["FC22-value"]


class Servers(unittest.TestCase):
    def setUp(self):
        need_network_of_its_own()
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-interop-"))
        self.addCleanup(shutil.rmtree, self.folder, True)

    def poll(self, name, kind):
        where, master_end = str(PORT), str(PORT)
        if kind == "rtu":
            line = Line(self.folder, name)
            self.addCleanup(line.close)
            where, master_end = line.slave, line.master
        server = Process([*SERVERS[name], kind, where], self.folder / f"{name}-{kind}.log")
        self.addCleanup(server.end)
        server.wait_for("ready")
        silent = [str(SILENT_S)] if NO_ANSWER.items() <= EXPECTED[name].items() else []
        done = subprocess.run([TESTS / "modbus_interop_master", kind, str(master_end), *silent], capture_output=True,
                              text=True, timeout=PATIENCE_S, check=False)
        server.end()
        found = dict(line.split(" ", 1) for line in done.stdout.splitlines())
        self.assertEqual(found, EXPECTED[name], done.stderr + server.output())
        self.assertEqual(done.returncode, 0)

    def test_tcp(self):
        for name in SERVERS:
            with self.subTest(name):
                self.poll(name, "tcp")

    def test_rtu(self):
        for name in SERVERS:
            with self.subTest(name):
                self.poll(name, "rtu")


if __name__ == "__main__":
    unittest.main()
