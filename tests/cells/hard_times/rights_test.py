"""Missing rights: what the user sees, and what a runtime without privileges still does."""

import os
import shutil
import unittest

from processes import NO_PLANT, Cell, stepwright

REAL = NO_PLANT + '[clock]\nmode = "real"\n'
NOBODY = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "--inh-caps=-all", "--bounding-set=-all")
NO_LIMITS = ("prlimit", "--rtprio=0:0", "--memlock=0:0")


@unittest.skipUnless(os.geteuid() == 0 and shutil.which("setpriv"), "needs root, to become somebody who may do nothing")
class Rights(unittest.TestCase):
    def cell(self, more=REAL, prefix=NOBODY):
        cell = Cell(more, prefix=prefix)
        self.addCleanup(cell.__exit__)
        cell.folder.chmod(0o755)
        return cell

    def refused(self, command, cell, pattern):
        process = cell.start(command)
        self.assertEqual(process.wait(), 1, process.output())
        self.assertRegex(process.output(), pattern)

    def test_a_state_folder_that_cannot_be_made(self):
        self.refused("runtime", self.cell(), r"state: R0078: the state folder cannot be made: Permission denied")

    def test_a_state_folder_of_somebody_else(self):
        cell = self.cell()
        cell.state.mkdir(mode=0o755)
        self.refused("runtime", cell, r"runtime\.sock: R0001: .*Permission denied")

    def test_a_configuration_that_cannot_be_read(self):
        cell = self.cell()
        cell.config.chmod(0o600)
        for command in ("runtime", "link", "hmi", "check"):
            self.refused(command, cell, r"cell\.toml: C0001: the file cannot be read: Permission denied")

    def test_a_log_that_cannot_be_written(self):
        cell = self.cell(REAL + '[log]\nfile = "cell.log"\n')
        for command in ("runtime", "link", "hmi"):
            self.refused(command, cell, r"cell\.toml:\d+:\d+: C0463: the log cannot be opened.*Permission denied")

    def test_without_privileges_it_runs_and_says_what_it_lacks(self):
        cell = self.cell(prefix=(*NO_LIMITS, *NOBODY))
        cell.state.mkdir()
        os.chown(cell.state, 65534, 65534)
        runtime = cell.start_runtime()
        runtime.wait_for(r"warning runtime: note: no real-time priority \(SCHED_FIFO: Operation not permitted\)")
        runtime.wait_for(r"memory is not locked \(mlockall: ")
        cell.load(10_000)
        self.assertGreaterEqual(cell.figure("stepwright_scans_total"), 0)
        self.assertEqual(runtime.end(), 0)

    def test_others_may_not_attend_it(self):
        cell = self.cell(prefix=())
        cell.start_runtime()
        cell.prefix = list(NOBODY)
        outsider = cell.start("metrics")
        self.assertEqual(outsider.wait(), 5)
        self.assertIn(f'stepwright_up{{runtime="{cell.name}"}} 0', outsider.output())
        reload = cell.start("reload")
        self.assertEqual(reload.wait(), 5)
        self.assertRegex(reload.output(), r"runtime\.sock: R0001: ")
        self.assertEqual(stepwright("metrics", "--config", cell.config).returncode, 0)


if __name__ == "__main__":
    unittest.main()
