"""What attends a gateway: the init system that starts it before its controller is there, and Prometheus."""

import json
import os
import pathlib
import shutil
import signal
import tempfile
import unittest

from cell_process import STEPWRIGHT
from controllers import Controller, eventually
from init_system import InitSystem
from processes import NO_PLANT, Process, figures_of

CELL = """\
[cell]
name = "attended-{pid}"
state_dir = "state"
[clock]
mode = "real"
[controller]
kind = "modbus-rtu"
device = "{device}"
lost_after_ms = 3000
timeout_ms = 500
{more}
[controller.metrics]
port = 0
""" + NO_PLANT


class Attended(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.line = self.folder / "line"
        self.init = InitSystem(self.folder)
        self.addCleanup(self.init.close)

    def start(self, more=""):
        cell = self.folder / "cell.toml"
        cell.write_text(CELL.format(pid=os.getpid(), device=self.line, more=more), encoding="utf-8")
        gateway = Process([STEPWRIGHT, "gateway", "--config", cell], self.folder / "gateway.log", env=self.init.environment)
        self.addCleanup(gateway.end)
        fetch = figures_of(gateway)
        runtime = ("runtime", f"attended-{os.getpid()}")
        return gateway, lambda name, *labels: fetch().get((f"stepwright_{name}", (runtime, *labels)))

    def test_without_a_controller_it_is_ready_alive_and_reloads(self):
        gateway, figure = self.start()
        self.assertTrue(self.init.heard(r"^READY=1\nSTATUS=waits for the controller"))
        self.assertGreaterEqual(self.init.beats(1.0), 4)
        self.assertEqual((figure("up"), figure("controller_contact")), (0, 0))
        gateway.send(signal.SIGHUP)
        gateway.wait_for("the configuration was read again")
        self.assertFalse((self.folder / "state/runtime.sock").exists(), "nobody is served without a controller")
        self.assertEqual(gateway.end(), 0)

    def test_a_controller_that_comes_is_a_runtime_in_the_figures(self):
        gateway, figure = self.start()
        self.assertEqual(figure("controller_contact"), 0)
        with Controller() as controller:
            self.line.symlink_to(controller.where)
            gateway.wait_for("listens on")
            # A state that could not be told in time makes way for the next one.
            self.assertTrue(self.init.heard(r"^STATUS=(gateway of .* listens on|no program is loaded)"))
            self.assertTrue(eventually(lambda: (figure("up"), figure("controller_contact")) == (1, 1)))
            self.assertEqual(figure("state", ("state", "empty")), 1)
            self.assertGreater(figure("resident_memory_bytes"), 1e6)
            losses = figure("controller_losses_total")
            controller.silence()
            self.assertTrue(eventually(lambda: figure("controller_contact") == 0))
            self.assertEqual(figure("up"), 0)
            self.assertEqual(figure("controller_losses_total"), losses + 1)
            self.assertGreater(figure("controller_repeated_requests_total"), 0)
            controller.speak()
            self.assertTrue(eventually(lambda: figure("controller_contact") == 1))
            self.assertGreaterEqual(self.init.beats(1.0), 4)

    def test_a_plan_by_hand_is_ready_alive_and_counted(self):
        (self.folder / "table.json").write_text(json.dumps({"registers": 1024, "actions": [
            {"number": 1, "action": "(go)", "after": []}, {"number": 2, "action": "(stop)", "after": [1]}]}), encoding="utf-8")
        gateway, figure = self.start('program = "loaded-by-hand"\nplan = "table.json"\n')
        self.assertTrue(self.init.heard(r"^READY=1\nSTATUS=follows the plan"))
        self.assertGreaterEqual(self.init.beats(1.0), 4)
        self.assertTrue(eventually(lambda: figure("controller_plan_actions") == 2))
        self.assertEqual((figure("controller_plan_actions_started"), figure("controller_contact")), (0, 0))
        gateway.send(signal.SIGHUP)
        gateway.wait_for("the configuration was read again")
        self.assertEqual(gateway.end(), 0)
        self.assertIn("STOPPING=1", self.init.listen())


if __name__ == "__main__":
    unittest.main()
