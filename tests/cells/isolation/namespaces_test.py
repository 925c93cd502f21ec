"""Two runtimes on two machines and one supervisor on a third, each machine a network namespace: they find each other,
run their programs, and the loss of each is noticed within a second."""

import re
import signal
import subprocess
import time
import unittest

from given_time import GivenTime
from namespaces import Network
from processes import NO_PLANT, TESTS, Cell, Process, eventually

DOMAIN = 6
HOSTS = {"a": "10.77.2.1", "b": "10.77.2.2", "s": "10.77.2.3"}
NOTICED_S = 1.0
REAL = NO_PLANT + '[clock]\nmode = "real"\n'


class Namespaces(unittest.TestCase):
    def setUp(self):
        self.network = Network(HOSTS)
        self.addCleanup(self.network.close)
        self.cells = {}
        for each in ("a", "b"):
            self.cells[each] = Cell(REAL, name=f"line-{each}", domain=DOMAIN, dds=f'interfaces = ["{HOSTS[each]}"]\n',
                                    prefix=self.network.prefix(each))
            self.addCleanup(self.cells[each].__exit__)
            self.cells[each].runtime = self.cells[each].start_runtime()
            self.cells[each].link = self.cells[each].start("link")
        self.supervisor = Process([*self.network.prefix("s"), TESTS / "cells_attend", str(DOMAIN), HOSTS["s"], "10000",
                                   "line-a", "line-b"], self.cells["a"].folder / "attend.log", stdin=subprocess.PIPE)
        self.cells["a"].processes.append(self.supervisor)
        for each in ("a", "b"):
            self.supervisor.wait_for(rf"running line-{each} \d+ ")

    def times(self, what, each):
        return [float(found) for found in re.findall(rf"^{what} line-{each} ([\d.]+)$", self.supervisor.output(), re.M)]

    def lost_after(self, each, act):
        """Seconds that the machine gave from when the act is done until the supervisor knows."""
        known = len(self.times("gone", each))
        act()
        began = time.monotonic()
        with GivenTime() as given:
            times = eventually(lambda: self.times("gone", each)[known:])
            seconds = given.seconds()
        self.assertTrue(times, self.supervisor.output())
        print(f"\n  line-{each}: noticed after {times[0] - began:.3f} s, seen after {seconds:.3f} s given")
        return seconds

    def other_runs_on(self, each):
        def scans():
            return int(re.findall(rf"^running line-{each} (\d+) ", self.supervisor.output(), re.M)[-1])
        before = scans()
        self.assertTrue(eventually(lambda: scans() > before + 100))

    def test_a_runtime_that_is_killed(self):
        cell = self.cells["a"]
        self.assertLess(self.lost_after("a", lambda: cell.runtime.send(signal.SIGKILL)), NOTICED_S)
        self.assertEqual(self.times("gone", "b"), [])
        self.other_runs_on("b")
        cell.start("runtime")
        self.assertTrue(eventually(lambda: self.times("back", "a")))

    def test_a_machine_that_is_gone(self):
        cell = self.cells["b"]

        def die():
            cell.link.send(signal.SIGKILL)
            cell.runtime.send(signal.SIGKILL)

        self.assertLess(self.lost_after("b", die), NOTICED_S)
        self.other_runs_on("a")

    def test_a_cable_that_is_pulled_and_plugged(self):
        self.assertLess(self.lost_after("a", lambda: self.network.cable("a", False)), NOTICED_S)
        self.other_runs_on("b")
        # The runtime behind the cable scans on, alone.
        before = self.cells["a"].figure("stepwright_scans_total")
        self.assertTrue(eventually(lambda: self.cells["a"].figure("stepwright_scans_total") > before + 100))
        self.network.cable("a", True)
        self.assertTrue(eventually(lambda: self.times("back", "a")), self.supervisor.output())

    def test_a_supervisor_that_is_gone_stops_nobody(self):
        self.supervisor.send(signal.SIGKILL)
        for cell in self.cells.values():
            before = cell.figure("stepwright_scans_total")
            self.assertTrue(eventually(lambda: cell.figure("stepwright_scans_total") > before + 100))


if __name__ == "__main__":
    unittest.main()
