"""Frames of every kind against stepwright modbus-server while the runtime behind it scans every millisecond: nothing
crashes, no memory grows, a valid request is answered all the while, and the scan does not notice.

Longer: STEPWRIGHT_FUZZ_FRAMES=1000000 STEPWRIGHT_FUZZ_AFTER=each STEPWRIGHT_FUZZ_SEED=7, with the environment of ctest."""

import json
import os
import pathlib
import subprocess
import time
import unittest

from disturbance import no_worse, watch
from namespaces import need_network_of_its_own
from processes import TESTS
from served import PORT, Served

FRAMES = int(os.environ.get("STEPWRIGHT_FUZZ_FRAMES", "20000"))
AFTER = os.environ.get("STEPWRIGHT_FUZZ_AFTER", "batch")
SEED = os.environ.get("STEPWRIGHT_FUZZ_SEED", "1")
WARM_UP = "2000"  # frames, after which a process has the memory that it needs
QUIET_S = 1.0  # only its memory is read
PATIENCE_S = 3600
# Writes are allowed in a part of the map, so that both ways of refusing have their turn.
CLIENT = """
[[modbus.server.client]]
address = "127.0.0.1"
read = ["all"]
write = ["coils 0-99", "holding 0-49"]
"""


def resident_kib(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
    return int(next(line for line in status.splitlines() if line.startswith("VmRSS")).split()[1])


class Fuzz(unittest.TestCase):
    def fuzz(self, frames, after):
        done = subprocess.run([TESTS / "modbus_socket_fuzz", str(PORT), str(frames), SEED, after], capture_output=True,
                              text=True, timeout=PATIENCE_S, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def test_the_server_stands_and_the_scan_does_not_notice(self):
        need_network_of_its_own()
        cell = Served(CLIENT)
        self.addCleanup(cell.__exit__)
        runtime, server = cell.start_all()
        cell.answers()
        quiet = watch(cell, lambda: time.sleep(QUIET_S))
        self.fuzz(WARM_UP, "batch")
        before = {each: resident_kib(each) for each in (runtime, server)}
        figures = {}
        abused = watch(cell, lambda: figures.update(self.fuzz(FRAMES, AFTER)))
        grown = {name: resident_kib(each) - before[each] for name, each in (("runtime", runtime), ("server", server))}
        print(f"\n  {figures}\n  grown: {grown} KiB")
        self.assertTrue(runtime.running() and server.running())
        self.assertGreaterEqual(figures["frames"], FRAMES)
        self.assertGreaterEqual(figures["valid"], FRAMES if AFTER == "each" else FRAMES / 250)
        self.assertGreater(figures["answers"], FRAMES / 2)
        for name, kib in grown.items():
            self.assertLess(kib, 512, name)
        no_worse(self, quiet, abused)


if __name__ == "__main__":
    unittest.main()
