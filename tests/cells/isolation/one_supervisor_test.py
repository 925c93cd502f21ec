"""One real supervisor on one machine attends the benches of two others (network namespaces): it plans for both, both
plans run, and the loss of a runtime is told within a second while the other one goes on."""

import re
import signal
import time
import unittest

from given_time import GivenTime
from namespaces import Network
from processes import SOURCES, STEPWRIGHT, Cell, Process, eventually, stepwright

DOMAIN = 7
HOSTS = {"a": "10.77.3.1", "b": "10.77.3.2", "s": "10.77.3.3"}
NOTICED_S = 1.0
BENCH = SOURCES / "tests/cells/bench"
# In real time: the job of the bench takes minutes, so that there is time to lose a runtime in.
JOB = f"""
[clock]
mode = "real"
[plant]
kind = "tank_bench"
[planning]
domain = "{BENCH}/domain.pddl"
problem = "{BENCH}/problem.pddl"
binding = "{BENCH}/binding.toml"
"""


class OneSupervisor(unittest.TestCase):
    def setUp(self):
        self.network = Network(HOSTS)
        self.addCleanup(self.network.close)
        self.cells, views = {}, []
        for each in ("a", "b"):
            self.cells[each] = Cell(JOB, name=f"bench-{each}", domain=DOMAIN, dds=f'interfaces = ["{HOSTS[each]}"]\n',
                                    prefix=self.network.prefix(each))
            self.addCleanup(self.cells[each].__exit__)
            self.cells[each].runtime = self.cells[each].start_runtime()
            self.cells[each].start("link")
            # The same cell as the supervisor's machine sees it.
            view = Cell(JOB, name=f"bench-{each}", domain=DOMAIN, dds=f'interfaces = ["{HOSTS["s"]}"]\nplace = "any"\n')
            self.addCleanup(view.__exit__)
            views += ["--config", view.config]
        self.supervisor = Process([*self.network.prefix("s"), STEPWRIGHT, "supervisor", *views],
                                  self.cells["a"].folder / "supervisor.log")
        self.cells["a"].processes.append(self.supervisor)
        for each in ("a", "b"):
            self.supervisor.wait_for(rf"bench-{each}: executing: ")

    def phases(self, each):
        return re.findall(rf"bench-{each}: (\w+): (.*)", self.supervisor.output())

    def test_a_runtime_that_is_lost_and_comes_back(self):
        for cell in self.cells.values():
            self.assertTrue(eventually(lambda: cell.figure("stepwright_scans_total") > 100))
        known = len(self.phases("a"))
        began = time.monotonic()
        self.cells["a"].runtime.send(signal.SIGKILL)
        with GivenTime() as given:
            told = eventually(lambda: [text for _, text in self.phases("a")[known:] if "does not answer" in text])
            seconds = given.seconds()
        print(f"\n  the supervisor told the loss after {time.monotonic() - began:.3f} s, {seconds:.3f} s given")
        self.assertTrue(told, self.supervisor.output())
        self.assertLess(seconds, NOTICED_S)
        self.assertEqual([text for _, text in self.phases("b") if "does not answer" in text], [])
        before = self.cells["b"].figure("stepwright_scans_total")
        self.assertTrue(eventually(lambda: self.cells["b"].figure("stepwright_scans_total") > before + 100))
        known = len(self.phases("a"))
        self.cells["a"].start("runtime")
        self.assertTrue(eventually(lambda: [word for word, _ in self.phases("a")[known:] if word == "executing"]),
                        self.supervisor.output())


class WrongCells(unittest.TestCase):
    def test_the_same_runtime_twice_is_refused(self):
        with Cell(JOB) as one, Cell(JOB) as other:
            done = stepwright("supervisor", "--config", one.config, "--config", other.config, "--once")
            self.assertEqual(done.returncode, 1)
            self.assertIn("C0467", done.stderr)
            self.assertIn(str(other.config), done.stderr)

    def test_a_cell_without_a_plan_is_refused_before_any_is_attended(self):
        with Cell(JOB, name="planned") as one, Cell(name="planless") as other:
            done = stepwright("supervisor", "--config", one.config, "--config", other.config, "--once")
            self.assertEqual(done.returncode, 1)
            self.assertIn("C0005", done.stderr)


if __name__ == "__main__":
    unittest.main()
