"""Reading the configuration again: by signal and by command, what changes, what waits, what is refused."""

import signal
import time
import unittest

from processes import NO_PLANT, Cell, eventually, stepwright

REAL = NO_PLANT + '[clock]\nmode = "real"\n'


def reload(cell):
    return stepwright("reload", "--config", cell.config)


class Reload(unittest.TestCase):
    def cell(self, more=REAL):
        cell = Cell(more)
        self.addCleanup(cell.__exit__)
        return cell

    def test_what_may_change_changes_and_the_rest_is_named(self):
        cell = self.cell()
        runtime = cell.start_runtime()
        cell.load(1_000)
        cell.write(REAL + '[log]\nlevel = "debug"\n[image]\ninput_bytes = 128\n')
        done = reload(cell)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"cell\.toml:\d+:\d+: note: C0464: 'log\.level' is \"debug\" from now on")
        self.assertRegex(done.stdout, r"cell\.toml:\d+:\d+: warning: C0465: 'image\.input_bytes' is 128 now")
        self.assertIn("needs a restart", done.stdout)
        cell.load(2_000)  # its steps are told at the new level
        runtime.wait_for("debug   runtime: steps changed")
        self.assertIn("needs a restart", reload(cell).stdout)
        self.assertNotIn("C0464", reload(cell).stdout)

    def test_the_program_goes_on_meanwhile(self):
        cell = self.cell()
        cell.start_runtime()
        cell.load(1_000)
        before = cell.figure("stepwright_scans_total")
        for number in range(50):
            cell.write(REAL + f"[log]\nlimit_per_s = {number + 1}\n")
            self.assertEqual(reload(cell).returncode, 0)
        self.assertGreater(cell.figure("stepwright_scans_total"), before + 50)
        key = (("runtime", cell.name), ("state", "running"))
        self.assertEqual(cell.metrics()[("stepwright_state", key)], 1)

    def test_a_wrong_file_is_refused_with_its_place_and_the_old_one_holds(self):
        for wrong, pattern in (('[log]\nlevel = "loud"\n', r"cell\.toml:\d+:\d+: C0006: 'loud'"),
                               ("[clock\n", r"cell\.toml:\d+:\d+: C0001"),
                               ('[safe_state.outputs]\n"%QX64.0" = "one"\n', r"cell\.toml:\d+:\d+: C0303"),
                               ('[log]\nlevel = "debug"\nfile = "/proc/none/x"\n', r"cell\.toml:\d+:\d+: C0463")):
            cell = self.cell()
            runtime = cell.start_runtime()
            cell.write(REAL + wrong)
            done = reload(cell)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertRegex(done.stderr, pattern)
            if wrong == "[clock\n":  # not even the socket is known of it: the command itself refuses
                runtime.send(signal.SIGHUP)
            runtime.wait_for(r"error   runtime: the configuration was refused, the previous one holds: ")
            cell.load(1_000)
            self.assertNotIn("debug   runtime", runtime.output())
            self.assertEqual(runtime.end(), 0)

    def test_the_time_until_a_supervisor_counts_as_lost_changes(self):
        cell = self.cell(REAL + "[safe_state]\nsupervisor_lost_after_ms = 600000\n")
        runtime = cell.start_runtime()
        cell.load(1_000, "barrier")  # a sign of life of a supervisor, the only one
        runtime.wait_for("a supervisor is there")
        time.sleep(0.3)
        self.assertNotIn("was lost", runtime.output())
        cell.write(REAL + "[safe_state]\nsupervisor_lost_after_ms = 100\n")
        self.assertEqual(reload(cell).returncode, 0)
        runtime.wait_for("the supervisor was lost")

    def test_a_signal_does_the_same_in_every_process(self):
        cell = self.cell(REAL + "[hmi]\nport = 0\n")
        processes = [cell.start_runtime(), cell.start("link"), cell.start("hmi")]
        processes[1].wait_for("Fast DDS domain")
        processes[2].wait_for("at http")
        cell.write(REAL + '[hmi]\nport = 0\n[log]\nlevel = "warning"\n')
        for process in processes:
            process.send(signal.SIGHUP)
        # Said at the old level or not at all: what follows is silence.
        time.sleep(1.0)
        cell.write(REAL + '[hmi]\nport = 0\n[log]\nlevel = "loud"\n')
        for process in processes:
            process.send(signal.SIGHUP)
            process.wait_for("the configuration was refused, the previous one holds: .*C0006")
        cell.write(REAL + '[hmi]\nport = 0\n')
        for process in processes:
            process.send(signal.SIGHUP)
            process.wait_for("the configuration was read again: .*'log.level' is left out from now on")
            self.assertTrue(process.running())

    def test_a_log_that_was_moved_away_is_opened_again(self):
        cell = self.cell(REAL + '[log]\nfile = "cell.log"\n')
        runtime = cell.start("runtime")
        log, old = cell.folder / "cell.log", cell.folder / "old.log"
        self.assertTrue(eventually(lambda: log.exists() and "listens on" in log.read_text(encoding="utf-8")))
        log.rename(old)
        runtime.send(signal.SIGHUP)
        self.assertTrue(eventually(log.exists))
        cell.load(1_000)
        self.assertTrue(eventually(lambda: "started" in log.read_text(encoding="utf-8")))

    def test_nobody_to_tell(self):
        cell = self.cell()
        done = reload(cell)
        self.assertEqual(done.returncode, 5)
        self.assertIn("is the runtime of this cell running?", done.stderr)


if __name__ == "__main__":
    unittest.main()
