"""A plan on a controller that takes no containers. The foreign PLC is a runtime of ours that runs what `translate
--handshake` wrote as PLCopen XML; all that the gateway has of it are five registers behind a Modbus server."""

import json
import pathlib
import shutil
import socket
import subprocess
import tempfile
import unittest

from cell_process import STEPWRIGHT, stepwright
from controllers import PATIENCE_S, eventually

BENCH = pathlib.Path(__file__).resolve().parent.parent / "bench"
PLC = """\
[cell]
name = "foreign-{port}"
state_dir = "plc"
[clock]
mode = "simulated"
speed = 40.0
[plant]
uncertainty = false    # a plan on paper knows no bias of a sensor
[modbus.server]
enabled = true
port = {port}
writable = true
[[modbus.server.client]]
address = "127.0.0.1"
read = ["all"]
write = ["holding 1024-1025"]
"""
GATEWAY = """\
[cell]
name = "hand-{port}"
state_dir = "gateway"
[controller]
kind = "modbus-tcp"
host = "127.0.0.1"
port = {port}
program = "loaded-by-hand"
plan = "table.json"
exchange_ms = 5
[log]
limit_per_s = 1000     # forty times as fast as a plant
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class ByHand(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        port = free_port()
        (self.folder / "plc.toml").write_text(PLC.format(port=port), encoding="utf-8")
        (self.folder / "gateway.toml").write_text(GATEWAY.format(port=port), encoding="utf-8")
        plan, xml = self.folder / "plan.txt", self.folder / "plan.xml"
        self.tool("plan", BENCH / "domain.pddl", BENCH / "problem.pddl", "--optimal", "--out", plan)
        self.tool("translate", plan, "--binding", BENCH / "binding.toml", "--to", "plcopen", "--handshake",
                  self.folder / "table.json", "-o", xml)
        self.tool("compile", xml, "-o", self.folder / "plan.swb")
        self.actions = json.loads((self.folder / "table.json").read_text(encoding="utf-8"))["actions"]

    def tool(self, *arguments, code=0):
        done = stepwright(*arguments)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout

    def start(self, command, config, says):
        log = self.folder / f"{command}.log"
        with open(log, "a", encoding="utf-8") as out:
            process = subprocess.Popen([STEPWRIGHT, command, "--config", self.folder / config], stdout=out, stderr=out)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertTrue(eventually(lambda: says in self.said(command)), self.said(command))
        return process

    def said(self, command):
        log = self.folder / f"{command}.log"
        return log.read_text(encoding="utf-8") if log.exists() else ""

    def start_plc(self):
        self.start("runtime", "plc.toml", "listens on")
        self.start("modbus-server", "plc.toml", "listens")
        self.tool("download", "--config", self.folder / "plc.toml", self.folder / "plan.swb", "--replace")
        self.tool("start", "--config", self.folder / "plc.toml")

    def test_every_action_is_granted_and_the_goal_is_reached(self):
        self.start_plc()
        gateway = self.start("gateway", "gateway.toml", "follows the plan")
        self.assertEqual(gateway.wait(timeout=PATIENCE_S), 0, self.said("gateway"))
        said = self.said("gateway")
        for action in self.actions:
            granted = said.index(f"action {action['number']} {action['action']} is granted")
            self.assertLess(granted, said.index(f"action {action['number']} {action['action']} started"))
            for before in action["after"]:
                self.assertLess(said.index(f"action {before} {self.actions[before - 1]['action']} started"), granted)
        self.assertIn("the plan is done", said)
        snapshot = self.tool("snapshot", "--config", self.folder / "plc.toml")
        self.assertRegex(snapshot, r"DONE_X\s+\S*\s*TRUE")

    def test_nothing_starts_that_is_not_granted_and_a_second_gateway_takes_up(self):
        self.start_plc()
        gateway = self.start("gateway", "gateway.toml", "follows the plan")
        self.assertTrue(eventually(lambda: "action 3 " in self.said("gateway")), self.said("gateway"))
        gateway.terminate()
        self.assertEqual(gateway.wait(timeout=PATIENCE_S), 0)
        self.assertIn("nothing is granted any more", self.said("gateway"))
        self.assertNotIn("the plan is done", self.said("gateway"))
        again = self.start("gateway", "gateway.toml", "follows the plan")
        self.assertEqual(again.wait(timeout=PATIENCE_S), 0, self.said("gateway"))
        self.assertIn("the plan is done", self.said("gateway"))

    def test_a_table_that_is_none_is_refused(self):
        (self.folder / "table.json").write_text('{"actions": 3}', encoding="utf-8")
        done = stepwright("gateway", "--config", self.folder / "gateway.toml")
        self.assertEqual(done.returncode, 1)
        self.assertIn("C0566", done.stderr)
        self.assertIn("hint:", done.stderr)


if __name__ == "__main__":
    unittest.main()
