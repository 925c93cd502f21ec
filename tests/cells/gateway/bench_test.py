"""The bench's plan on a controller that is reached over Modbus only, with all real processes."""

import tempfile
import unittest

from cell_process import stepwright
from controllers import Controller, run_bench


class Bench(unittest.TestCase):
    def test_the_trace_is_that_of_the_host_over_either_line(self):
        host, code = run_bench()
        self.assertEqual(code, 0, host["stdout"])
        for tcp in (False, True):
            with self.subTest(tcp=tcp), Controller(tcp) as controller:
                report, code = run_bench("--controller", controller.where)
                self.assertEqual(code, 0, report["stdout"])
                self.assertTrue(report["goal_reached"])
                self.assertEqual(report["trace_hash"], host["trace_hash"])
                self.assertEqual(report["scans"], host["scans"])
                self.assertEqual(report["plant"], host["plant"])
                self.assertEqual(report["processes"], ["gateway", "link", "supervisor"])
                print(f"{'tcp' if tcp else 'rtu'}: turn p50 {report['scan_p50_us']:.0f} us, "
                      f"p99 {report['scan_p99_us']:.0f} us, {report['realtime_factor']:.1f} x real time")

    def test_another_seed_gives_the_trace_of_that_seed(self):
        host, _ = run_bench("--seed", 7)
        with Controller(tcp=True) as controller:
            report, code = run_bench("--seed", 7, "--controller", controller.where)
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["trace_hash"], host["trace_hash"])

    def test_replanning_does_without_an_online_change(self):
        with Controller(tcp=True) as controller:
            report, code = run_bench("--controller", controller.where, "--fault", "(demand c1)=8@20")
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["replans"], 1)
        self.assertTrue(report["goal_reached"])

    def test_a_fault_of_the_plant_reaches_the_controller(self):
        with Controller(tcp=True) as controller:
            report, code = run_bench("--controller", controller.where, "--fault", "leak_a1=0.3@40")
        self.assertIn(code, (0, 5), report["stdout"])
        self.assertGreaterEqual(report["replans"], 1)
        self.assertEqual(report["goal_reached"], code == 0)


class WrongInput(unittest.TestCase):
    def refused(self, *arguments):
        done = stepwright(*arguments)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        return done.stderr

    def test_what_is_no_controller_is_refused(self):
        said = self.refused("demo", "bench", "--headless", "--controller", "quemu")
        self.assertIn("M0006", said)
        self.assertIn("hint: qemu", said)

    def test_each_scan_process_refuses_the_other_ones_cells(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as cell:
            cell.write('[cell]\nname = "x"\n[controller]\nkind = "modbus-tcp"\nhost = "127.0.0.1"\n')
            cell.flush()
            said = self.refused("runtime", "--config", cell.name)
            self.assertIn("C0564", said)
            self.assertIn(":3:", said)  # the table of the controller
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as cell:
            cell.write('[cell]\nname = "x"\n')
            cell.flush()
            self.assertIn("C0564", self.refused("gateway", "--config", cell.name))

    def test_every_mistake_of_the_table_has_its_place(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as cell:
            cell.write('[cell]\nname = "x"\n[controller]\nkind = "modbus-rtu"\nhost = "h"\nunit = 300\n'
                       '[record]\nfile = "a"\n')
            cell.flush()
            done = stepwright("check", "--config", cell.name)
            self.assertEqual(done.returncode, 1)
            said = done.stdout + done.stderr
            for place in (":4:8: C0561", ":5:8: C0562", ":6:8: C0004", ":8:8: C0563"):
                self.assertIn(place, said)


if __name__ == "__main__":
    unittest.main()
