"""The calendar jumps by a day, forward and back: scans, timers and clients of a runtime do not notice."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from processes import NO_PLANT, PATIENCE_S, TESTS, Cell, eventually

JUMP = TESTS / "libcells_calendar_jump.so"
REAL = NO_PLANT + '[clock]\nmode = "real"\n'
DAY_S = 86_400


def jumping(report):
    return {**os.environ, "LD_PRELOAD": str(JUMP), "CALENDAR_JUMP_REPORT": str(report)}


class Clock(unittest.TestCase):
    def test_the_calendar_of_this_test_does_jump(self):
        script = ("import time\nseen = set()\nfor _ in range(60):\n  seen.add(round((time.time() - START) / 86400))\n"
                  "  time.sleep(0.005)\nprint(sorted(seen))").replace("START", repr(time.time()))
        done = subprocess.run([sys.executable, "-c", script], env={**os.environ, "LD_PRELOAD": str(JUMP)},
                              capture_output=True, text=True, timeout=PATIENCE_S, check=True)
        self.assertEqual(done.stdout.strip(), "[-1, 0, 1]")

    def test_scans_go_on_and_the_scan_clock_keeps_its_pace(self):
        with Cell(REAL) as cell:
            report = cell.folder / "calendar"
            runtime = cell.start_runtime(env=jumping(report))
            cell.load(10_000)
            key = (("runtime", cell.name),)

            def looked_at():
                """Scans and scan clock, and the instants between which that was."""
                before, figures = time.monotonic(), cell.metrics()
                return (figures[("stepwright_scans_total", key)], figures[("stepwright_scan_clock_seconds_total", key)],
                        before, time.monotonic())

            scans, clock, before, after = looked_at()
            self.assertTrue(eventually(lambda: looked_at()[0] >= scans + 300), runtime.output())
            last = cell.metrics()
            more, clock_then, before_then, after_then = looked_at()
            self.assertGreater(clock_then - clock, before_then - after - 0.5)
            self.assertLess(clock_then - clock, after_then - before + 0.5)
            self.assertLess(more - scans, (after_then - before) / 0.01 + 50)
            self.assertEqual(last[("stepwright_state", (*key, ("state", "running")))], 1)
            self.assertLess(last[("stepwright_uptime_seconds", key)], 60)
            self.assertEqual(runtime.end(), 0)
            figures = re.findall(r"readings (\d+) waits (\d+)", report.read_text(encoding="utf-8"))
            # The last process of the chain of exec is the runtime: it reads the calendar for its log and waits for
            # nothing by it.
            self.assertGreater(int(figures[-1][0]), 0)
            self.assertEqual(int(figures[-1][1]), 0)

    def test_a_lost_supervisor_is_told_from_a_jump(self):
        with Cell(REAL + '[safe_state]\nsupervisor_lost_after_ms = 600000\non_lost_supervisor = "safe"\n') as cell:
            runtime = cell.start_runtime(env=jumping(cell.folder / "calendar"))
            cell.load(1_000, "barrier")  # a start with a barrier is a sign of life
            time.sleep(2.0)
            key = (("runtime", cell.name), ("state", "running"))
            self.assertEqual(cell.metrics()[("stepwright_state", key)], 1)
            self.assertNotIn("supervisor was lost", runtime.output())

    @unittest.skipUnless(shutil.which("strace") and os.geteuid() == 0, "needs strace, and root to attach it")
    def test_no_system_call_waits_by_the_calendar(self):
        with Cell(REAL) as cell:
            runtime = cell.start_runtime()
            cell.load(1_000)
            report = cell.folder / "strace"
            trace = subprocess.Popen(["strace", "-f", "-o", report, "-p", str(runtime.pid)],
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            eventually(lambda: report.exists() and report.stat().st_size > 50_000)
            trace.send_signal(signal.SIGINT)
            trace.wait(timeout=PATIENCE_S)
            calls = report.read_text(encoding="utf-8")
            self.assertIn("clock_nanosleep(CLOCK_MONOTONIC", calls)
            # The C library names the calendar's clock also where a wait has no end (its time is NULL).
            timed = re.sub(r"FUTEX_WAIT_BITSET_PRIVATE\|FUTEX_CLOCK_REALTIME, \w+, NULL", "", calls)
            self.assertNotIn("CLOCK_REALTIME", timed)
            self.assertNotIn("timer_create", calls)


if __name__ == "__main__":
    unittest.main()
