"""Starts and stops, ten thousand of a program and hundreds of the process: nothing adds up."""

import os
import pathlib
import re
import signal
import subprocess
import unittest

from processes import NO_PLANT, PATIENCE_S, TESTS, Cell, eventually

PROGRAM_STARTS = 10_000
PROCESS_STARTS = 200


class Restart(unittest.TestCase):
    def test_ten_thousand_starts_of_a_program_cost_no_memory_and_no_descriptor(self):
        done = subprocess.run([TESTS / "cells_restarts", str(PROGRAM_STARTS)], capture_output=True, text=True, timeout=PATIENCE_S,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        print(done.stdout.strip())
        figures = {line.split()[0]: [int(each) for each in re.findall(r"\d+", line)] for line in done.stdout.splitlines()}
        early, late = figures["early"], figures["late"]
        self.assertLess(late[0], early[0] * 1.05 + 512)
        self.assertEqual(late[1:], early[1:])

    def test_two_hundred_starts_of_the_process_leave_nothing_behind(self):
        with Cell(NO_PLANT) as cell:
            cell.start_runtime().end()
            shared = sorted(os.listdir("/dev/shm"))
            kept = sorted(path.name for path in cell.state.iterdir())
            for number in range(PROCESS_STARTS):
                runtime = cell.start_runtime()
                if number % 50 == 0:
                    cell.load(1_000)
                self.assertEqual(runtime.end(), 0)
                cell.processes.clear()
            self.assertEqual(sorted(path.name for path in cell.state.iterdir()), kept)
            self.assertEqual([name for name in os.listdir("/dev/shm") if name not in shared and "stepwright" in name], [])

    def test_a_killed_process_never_keeps_the_next_one_from_starting(self):
        with Cell('[clock]\nspeed = 1.0\n') as cell:
            for number in range(PROCESS_STARTS // 4):
                runtime = cell.start_runtime()
                if number % 10 == 0:
                    cell.load(1_000)
                self.assertEqual(runtime.end(signal.SIGKILL), -signal.SIGKILL)
                cell.processes.clear()
            self.assertEqual(cell.start_runtime().end(), 0)

    def test_a_stop_at_any_moment_of_the_start_is_clean(self):
        with Cell('[clock]\nspeed = 1.0\n') as cell:
            for delay_ms in range(40):
                runtime = cell.start("runtime")
                eventually(lambda: False, patience_s=delay_ms / 1000, pause_s=0.001)
                code = runtime.end()
                # Before it has begun the signal ends it as it ends any program; from there on it ends by itself.
                self.assertIn(code, (0, -signal.SIGTERM), runtime.output())
                if "listens on" in runtime.output():
                    self.assertEqual(code, 0)
                cell.processes.clear()
            self.assertFalse(pathlib.Path(cell.socket).exists())


if __name__ == "__main__":
    unittest.main()
