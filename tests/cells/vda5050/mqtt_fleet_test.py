#!/usr/bin/python3
"""A fleet over a real MQTT broker (mosquitto): master control of ours, vehicles over paho-mqtt, mosquitto_sub beside."""

import json
import os
import pathlib
import socket
import subprocess
import tempfile
import time
import unittest

import jsonschema

from vehicle_peer import MANUFACTURER, Vehicle

SOURCE = pathlib.Path(os.environ["STEPWRIGHT_SOURCE_DIR"])
MASTER = os.path.join(os.environ["STEPWRIGHT_TEST_DIR"], "vda5050_master")
VEHICLES, SEED, PATIENCE_S = 4, 3, 600


def judges() -> dict:
    rules = json.loads((SOURCE / "tests/conformance/vda5050/rules.json").read_text(encoding="utf-8"))
    return {t: jsonschema.Draft202012Validator({"$ref": f"#/$defs/{t}", "$defs": rules["$defs"]}) for t in ("order", "state")}


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Broker:
    def __init__(self, folder: str, certificate: str = "", more: tuple[str, ...] = ("allow_anonymous true",)):
        self.folder, self.certificate, self.more = folder, certificate, more
        for _ in range(5):  # another process may take the port first
            self.port = free_port()
            if self.start():
                return
        raise RuntimeError("mosquitto does not start")

    def start(self) -> bool:
        config = pathlib.Path(self.folder, f"mosquitto{self.port}.conf")
        lines = ["user root", f"listener {self.port} 127.0.0.1", *self.more, "persistence false"]
        if self.certificate:
            lines += [f"certfile {self.certificate}.pem", f"keyfile {self.certificate}.key"]
        config.write_text("\n".join(lines) + "\n", encoding="utf-8")
        self.log = pathlib.Path(self.folder, f"mosquitto{self.port}.log")
        with self.log.open("w", encoding="utf-8") as log:
            self.process = subprocess.Popen(["/usr/sbin/mosquitto", "-c", str(config)], stdout=log, stderr=log)
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end and self.process.poll() is None:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", self.port)) == 0:
                    return True
            time.sleep(0.01)
        return False

    def stop(self):
        self.process.kill()
        self.process.wait()


def wait_until(condition, what: str):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(what)
        time.sleep(0.01)


class MqttFleet(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.broker = Broker(self.folder.name)
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(lambda: self.broker.stop())

    def read(self, topic: str, count: int) -> list[str]:
        """What mosquitto_sub gets of it, retained messages first."""
        done = subprocess.run(["mosquitto_sub", "-h", "127.0.0.1", "-p", str(self.broker.port), "-t", topic, "-C", str(count),
                               "-W", str(PATIENCE_S)], capture_output=True, text=True, check=True)
        return done.stdout.splitlines()

    def test_Fleet_WhenTheBrokerDiesAndReturns_ThenAllVehiclesArriveAndEveryMessageIsSound(self):
        vehicles = [Vehicle(f"v{k + 1}", self.broker.port, judges()) for k in range(VEHICLES)]
        log = pathlib.Path(self.folder.name, "master.log")
        with log.open("w", encoding="utf-8") as output:
            master = subprocess.Popen([MASTER, str(self.broker.port), str(VEHICLES), str(SEED), str(PATIENCE_S)], stdout=output)
        self.addCleanup(master.kill)
        text = lambda: log.read_text(encoding="utf-8")
        wait_until(lambda: all(v.order is not None for v in vehicles), "first orders")
        for vehicle in vehicles:
            vehicle.tick()
        self.broker.stop()  # in the middle: what is said now is lost
        for vehicle in vehicles:
            vehicle.tick()
        self.assertTrue(self.broker.start())
        wait_until(lambda: "connected 2" in text() and all(v.client.is_connected() for v in vehicles), "connections made again")
        end = time.monotonic() + PATIENCE_S
        while master.poll() is None and time.monotonic() < end:
            for vehicle in vehicles:
                vehicle.tick()
            time.sleep(0.02)
        self.assertEqual(master.wait(PATIENCE_S), 0, text())
        report = json.loads(text().splitlines()[-1])
        self.assertEqual(report["wrong"], 0, text())
        self.assertTrue(all(v.arrived() for v in vehicles))
        self.assertEqual([fault for v in vehicles for fault in v.faults], [])
        self.assertGreater(sum(v.updates for v in vehicles), 0)
        for vehicle in vehicles:
            vehicle.leave()

    def cancels(self, lost: int) -> tuple[str, Vehicle, int | None]:
        """What a master control says that cancels the order of v1, of whose cancelOrders so many are lost; and its exit code."""
        vehicles = [Vehicle(f"v{k + 1}", self.broker.port, judges(), lost if k == 0 else 0) for k in range(2)]
        log = pathlib.Path(self.folder.name, f"master{lost}.log")
        with log.open("w", encoding="utf-8") as output:
            master = subprocess.Popen([MASTER, str(self.broker.port), "2", str(SEED), str(PATIENCE_S), "cancel=v1"], stdout=output)
        self.addCleanup(master.wait)
        self.addCleanup(master.kill)
        end = time.monotonic() + PATIENCE_S
        while master.poll() is None and "F0910" not in log.read_text(encoding="utf-8") and time.monotonic() < end:
            for vehicle in vehicles:
                vehicle.tick()
            time.sleep(0.02)
        if master.poll() is None:
            time.sleep(1.0)  # nothing more is to come
        for vehicle in vehicles:
            vehicle.leave()
        return log.read_text(encoding="utf-8"), vehicles[0], master.poll()

    def test_CancelOrder_WhenItIsLostTwice_ThenItComesAgainUntilTheVehicleConfirmsIt(self):
        said, vehicle, code = self.cancels(2)
        self.assertEqual(code, 0, said)
        self.assertIn("cancelled", said)
        self.assertGreaterEqual(len(vehicle.cancels), 3)
        self.assertEqual(len(set(vehicle.cancels)), 1)  # always the same one
        self.assertIsNone(vehicle.order)

    def test_CancelOrder_WhenNobodyConfirmsIt_ThenThatIsToldOnceAndItEnds(self):
        said, vehicle, code = self.cancels(1000)
        self.assertIsNone(code, said)
        self.assertEqual(said.count("F0910"), 1, said)
        self.assertEqual(len(vehicle.cancels), 4)

    def test_Vehicle_WhenItsConnectionBreaks_ThenTheLastWillIsToldAndKept(self):
        vehicles = [Vehicle(f"v{k + 1}", self.broker.port, judges()) for k in range(2)]
        log = pathlib.Path(self.folder.name, "master.log")
        with log.open("w", encoding="utf-8") as output:
            master = subprocess.Popen([MASTER, str(self.broker.port), "2", str(SEED), str(PATIENCE_S)], stdout=output)
        self.addCleanup(master.wait)
        self.addCleanup(master.kill)
        text = lambda: log.read_text(encoding="utf-8")
        wait_until(lambda: "online v1" in text() and "online v2" in text(), "vehicles online")
        vehicles[0].vanish()
        wait_until(lambda: "lost v1" in text(), "the last will of v1")
        vehicles[1].leave()
        wait_until(lambda: "lost v2" in text(), "the farewell of v2")
        states = {m["serialNumber"]: m["connectionState"] for m in map(json.loads, self.read(f"uagv/v2/{MANUFACTURER}/+/connection", 2))}
        self.assertEqual(states, {"v1": "CONNECTIONBROKEN", "v2": "OFFLINE"})
        # Somebody who is no vehicle, and what is no message, are told and harm nothing.
        for serial, payload in (("v1", "{"), ("v1", vehicles[1].message("state", **vehicles[1].state()))):
            subprocess.run(["mosquitto_pub", "-h", "127.0.0.1", "-p", str(self.broker.port), "-t",
                            f"uagv/v2/{MANUFACTURER}/{serial}/state", "-m", payload], check=True)
        wait_until(lambda: "F0901" in text() and "F0907" in text(), "both refusals")
        self.assertIsNone(master.poll())

    def test_Master_WhenTheBrokerHasTls_ThenItConnectsToTheOneThatItTrustsOnly(self):
        def made(name: str) -> str:
            """A certificate that signs itself, and its key."""
            path = os.path.join(self.folder.name, name)
            subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2",
                            "-subj", "/CN=broker", "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", f"{path}.key", "-out", f"{path}.pem"],
                           capture_output=True, check=True)
            return path

        certificate, other = made("broker"), made("other")
        broker = Broker(self.folder.name, certificate)
        self.addCleanup(broker.stop)

        def master(trusted: str) -> pathlib.Path:
            log = pathlib.Path(self.folder.name, os.path.basename(trusted) + ".log")
            with log.open("w", encoding="utf-8") as output:
                process = subprocess.Popen([MASTER, str(broker.port), "2", str(SEED), str(PATIENCE_S), trusted + ".pem"], stdout=output)
            self.addCleanup(process.wait)
            self.addCleanup(process.kill)
            return log

        distrusts = master(other)
        wait_until(lambda: "unknown ca" in broker.log.read_text(encoding="utf-8"), "the refusal in the broker's log")
        trusts = master(certificate)
        wait_until(lambda: "connected 1" in trusts.read_text(encoding="utf-8"), "a connection inside TLS")
        self.assertEqual(distrusts.read_text(encoding="utf-8"), "")
        missing = subprocess.run([MASTER, str(broker.port), "2", str(SEED), "1", os.path.join(self.folder.name, "none.pem")],
                                 capture_output=True, text=True, check=False)
        self.assertEqual(missing.returncode, 1)
        self.assertIn("MQ002", missing.stdout)


if __name__ == "__main__":
    unittest.main()
