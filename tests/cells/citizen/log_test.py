"""The log of the real processes: texts for people, JSON lines for machines, limited per kind, never of the scan."""

import json
import os
import re
import shutil
import signal
import subprocess
import unittest

from processes import NO_PLANT, PATIENCE_S, TESTS, Cell, eventually


def lines(file):
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []


class Log(unittest.TestCase):
    def test_every_process_writes_whole_json_lines_into_one_file(self):
        with Cell(NO_PLANT + '[log]\nformat = "json"\nfile = "cell.log"\n') as cell:
            runtime = cell.start("runtime")
            log = cell.folder / "cell.log"
            eventually(lambda: any(line["kind"] == "listens" for line in lines(log)))
            link = cell.start("link")
            eventually(lambda: any(line["kind"] == "connected" for line in lines(log)))
            cell.load(1_000_000)
            digest = cell.load(500_000, "trap")
            eventually(lambda: any(line["kind"] == "trap" for line in lines(log)))
            runtime.end()
            link.end()
            found = lines(log)
            self.assertEqual({line["process"] for line in found}, {"runtime", "link"})
            kinds = {line["kind"] for line in found}
            self.assertLessEqual({"listens", "connected", "client", "loaded", "started", "stopped", "trap", "ends"}, kinds)
            for line in found:
                self.assertLessEqual({"time", "level", "process", "kind", "message"}, set(line))
            trap = next(line for line in found if line["kind"] == "trap")
            self.assertEqual((trap["digest"], trap["level"]), (digest, "error"))
            self.assertEqual(runtime.output(), "")

    def test_a_trap_is_an_error_with_its_place(self):
        with Cell(NO_PLANT) as cell:
            runtime = cell.start_runtime()
            cell.load(1_000, "trap")
            runtime.wait_for(r"error   runtime: scan \d+: .*\bR?\w+")
            self.assertEqual(cell.metrics()[("stepwright_traps_total", (("runtime", cell.name),))], 1)

    def test_a_refused_download_is_told_with_its_digest(self):
        with Cell(NO_PLANT) as cell:
            runtime = cell.start_runtime()
            refused = subprocess.run([TESTS / "cells_load", cell.socket, "1000", "damaged"], capture_output=True,
                                     text=True, timeout=PATIENCE_S, check=False)
            self.assertEqual(refused.returncode, 1, refused.stderr)
            runtime.wait_for(r"warning runtime: download [0-9a-f]{12} of 'cells_load' was refused: ")

    def test_a_flood_of_one_kind_is_limited_and_counted(self):
        with Cell(NO_PLANT + '[log]\nformat = "json"\nlimit_per_s = 4\n') as cell:
            runtime = cell.start_runtime()
            for _ in range(30):
                subprocess.run([TESTS / "cells_load", cell.socket, "1000", "hello"], check=True, timeout=PATIENCE_S)
            runtime.end()
            found = lines(runtime.log)
            written = [line for line in found if line["kind"] == "client"]
            suppressed = sum(line["count"] for line in found if line.get("of") == "client")
            self.assertEqual(len(written) + suppressed, 60)
            self.assertGreater(suppressed, 0)

    @unittest.skipUnless(shutil.which("strace") and os.geteuid() == 0, "needs strace, and root to attach it")
    def test_the_scan_thread_never_writes(self):
        with Cell(NO_PLANT + '[clock]\nmode = "real"\n[log]\nlevel = "debug"\n') as cell:
            runtime = cell.start_runtime()
            cell.load(1_000)
            threads = [int(tid) for tid in os.listdir(f"/proc/{runtime.pid}/task") if int(tid) != runtime.pid]
            report = cell.folder / "strace"
            trace = subprocess.Popen(["strace", "-f", "-o", report, *sum((["-p", str(tid)] for tid in threads), [])],
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            eventually(lambda: report.exists() and report.stat().st_size > 10_000)
            trace.send_signal(signal.SIGINT)
            trace.wait(timeout=PATIENCE_S)
            calls = report.read_text(encoding="utf-8")
            # The scan is the thread that sleeps until its next scan; others of the process may write.
            sleepers = {line.split()[0] for line in calls.splitlines() if "clock_nanosleep(" in line}
            self.assertEqual(len(sleepers), 1)
            of_scan = [line for line in calls.splitlines() if line.split()[0] in sleepers]
            # The notifier of the service is the one descriptor that a scan may touch.
            files = re.compile(r"\b(open|openat|sendto|sendmsg|writev|pwrite64|fsync|fdatasync)\(|\bwrite\([012],")
            self.assertEqual([line for line in of_scan if files.search(line)], [])


if __name__ == "__main__":
    unittest.main()
