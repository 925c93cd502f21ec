"""The bench's plan on the firmware in QEMU, the plant on the host, Modbus RTU between them."""

import signal
import time
import unittest

from cell_process import Demo
from controllers import run_bench


class Emulator(unittest.TestCase):
    def test_the_trace_on_the_emulated_board_is_that_of_the_host_also_when_its_machine_holds_it_up(self):
        """For longer than the board's watchdog waits, at work and asleep."""
        host, _ = run_bench()
        with Demo("--fast", "--no-compare", "--set", "controller.lost_after_ms=60000", "--controller", "qemu") as demo:
            demo.wait_for_actions(1)  # held up in its very first turn it is lost, and the run ends safely
            demo.hold_up_foreign("qemu-system-arm", 6.0)
            demo.wait_for_actions(2)
            demo.kill("gateway", signal.SIGSTOP)  # nothing is asked of the board any more: it falls asleep
            time.sleep(1)
            demo.hold_up_foreign("qemu-system-arm", 6.0)
            demo.kill("gateway", signal.SIGCONT)
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["trace_hash"], host["trace_hash"])
        self.assertEqual(report["scans"], host["scans"])
        self.assertEqual(report["processes"], ["qemu", "gateway", "link", "supervisor"])
        print(f"turn p50 {report['scan_p50_us']:.0f} us, p99 {report['scan_p99_us']:.0f} us, "
              f"{report['realtime_factor']:.1f} x real time")

    def test_an_emulator_that_is_killed_ends_the_plan_safely(self):
        with Demo("--no-compare", "--set", "clock.speed=3", "--set", "controller.lost_after_ms=3000", "--controller", "qemu") as demo:
            demo.wait_for_line("gateway", "program .* started")
            demo.kill_foreign("qemu-system-arm")
            report, code = demo.result()
        self.assertEqual(code, 5, report["stdout"])
        self.assertIn("lost", report["message"])
        self.assertEqual(report["restarts"].get("qemu"), 1)


if __name__ == "__main__":
    unittest.main()
