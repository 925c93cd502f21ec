#!/usr/bin/python3
"""A fleet that runs (real runtime, simulated forklifts) on a real broker: `stepwright vda5050 publish`, judged by jsonschema."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import jsonschema
import paho.mqtt.client as mqtt

from mqtt_fleet_test import PATIENCE_S, SOURCE, Broker, wait_until
from vehicle_peer import MANUFACTURER, now

BIN = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"])
FLEET = os.path.join(os.environ["STEPWRIGHT_TEST_DIR"], "vda5050_fleet")
CELL = SOURCE / "tests/cells/vda5050/cell.toml"
TOPICS = ("order", "instantActions", "state", "visualization", "connection", "factsheet")
VEHICLES = ("v1", "v2", "v3")
LENGTH_M, WIDTH_M = 36.0, 24.0  # of the hall


def judges() -> dict:
    rules = json.loads((SOURCE / "tests/conformance/vda5050/rules.json").read_text(encoding="utf-8"))
    return {t: jsonschema.Draft202012Validator({"$ref": f"#/$defs/{t}", "$defs": rules["$defs"]}) for t in TOPICS}


class Listener:
    """Hears all that is said of the fleet, and holds it against the schemas and against what was said before."""

    def __init__(self, port: int):
        self.judges, self.lock, self.faults, self.said = judges(), threading.Lock(), [], []
        self.strangers = set()  # payloads of the test's own
        self.held, self.numbers, self.places = {}, {}, {}
        self.lossy = False  # the broker was away: orders may be missing
        self.client = mqtt.Client(client_id="listener")
        self.client.reconnect_delay_set(1, 1)
        self.client.on_connect = lambda client, *_: client.subscribe("uagv/v2/#", 1)
        self.client.on_message = self.hear
        self.client.connect("127.0.0.1", port, 15)
        self.client.loop_start()

    def hear(self, _client, _data, message):
        with self.lock:
            if message.payload in self.strangers:
                return
            _, _, _, serial, topic = message.topic.split("/")
            content = json.loads(message.payload)
            faults = [f"{topic} of {serial}: {e.message} at {list(e.path)}" for e in self.judges[topic].iter_errors(content)]
            if content["serialNumber"] != serial or content["manufacturer"] != MANUFACTURER:
                faults.append(f"{message.topic}: another one's name")
            if message.retain and topic not in ("connection", "factsheet"):
                faults.append(f"{message.topic} is retained")
            self.faults += faults
            self.said.append((serial, topic, content))
            if topic in ("order", "state", "visualization"):
                getattr(self, f"hear_{topic}")(serial, content)

    def fault(self, what: str):
        self.faults.append(what)

    def hear_order(self, serial: str, order: dict):
        released = [node["released"] for node in order["nodes"]]
        if released != sorted(released, reverse=True):
            self.fault(f"{serial}: base behind horizon")
        held = self.held.get(serial)
        if held is None or held["orderId"] != order["orderId"]:
            if order["orderUpdateId"] != 0 and not self.lossy:
                self.fault(f"{serial}: a new order begins with update {order['orderUpdateId']}")
            self.held[serial] = order
            return
        if order["orderUpdateId"] <= held["orderUpdateId"]:
            return  # sent again
        if self.lossy and order["orderUpdateId"] > held["orderUpdateId"] + 1:
            self.held[serial] = order
            return
        if order["orderUpdateId"] != held["orderUpdateId"] + 1:
            self.fault(f"{serial}: update {order['orderUpdateId']} after {held['orderUpdateId']}")
            return
        end = max(k for k, node in enumerate(held["nodes"]) if node["released"])
        if order["nodes"][0] != held["nodes"][end]:
            self.fault(f"{serial}: update {order['orderUpdateId']} does not begin where the base ends")
            return
        order["nodes"] = held["nodes"][:end] + order["nodes"]
        order["edges"] = held["edges"][:end] + order["edges"]
        if sum(node["released"] for node in order["nodes"]) <= end:
            self.fault(f"{serial}: update {order['orderUpdateId']} takes back some of the base")
        self.held[serial] = order

    def hear_state(self, serial: str, state: dict):
        self.within(serial, state)
        before = self.numbers.get(serial)
        self.numbers[serial] = state
        held = self.held.get(serial)
        if held is None or state["orderId"] != held["orderId"] or state["orderUpdateId"] != held["orderUpdateId"]:
            return
        ahead = [node["nodeId"] for node in state["nodeStates"]]
        ids = [node["nodeId"] for node in held["nodes"]]
        if self.lossy and len(ahead) >= len(ids):
            return
        if ahead != ids[len(ids) - len(ahead):]:
            self.fault(f"{serial}: the nodes ahead are not those of the order")
        behind = len(ids) - len(ahead)
        if behind and (state["lastNodeId"] != ids[behind - 1] or not held["nodes"][behind - 1]["released"]):
            self.fault(f"{serial}: its last node '{state['lastNodeId']}' is not where its base has led")
        if before and before["orderId"] == state["orderId"] and state["lastNodeSequenceId"] < before["lastNodeSequenceId"]:
            if before["lastNodeId"] in ids:
                self.fault(f"{serial}: goes back from node {before['lastNodeSequenceId']} to {state['lastNodeSequenceId']}")

    def hear_visualization(self, serial: str, place: dict):
        self.within(serial, place)
        self.places.setdefault(serial, []).append(place["agvPosition"])

    def within(self, serial: str, message: dict):
        place = message.get("agvPosition")
        if place and not (0 < place["x"] < LENGTH_M and 0 < place["y"] < WIDTH_M and place["mapId"] == "map"):
            self.fault(f"{serial} is outside of the hall: {place}")

    def last(self, serial: str, topic: str):
        with self.lock:
            return next((c for s, t, c in reversed(self.said) if (s, t) == (serial, topic)), None)

    def heard(self) -> int:
        with self.lock:
            return len(self.said)

    def since(self, index: int, serial: str, topic: str):
        with self.lock:
            return [c for s, t, c in self.said[index:] if (s, t) == (serial, topic)]

    def send(self, serial: str, topic: str, content):
        payload = content if isinstance(content, bytes) else json.dumps(content).encode()
        with self.lock:
            self.strangers.add(payload)
        self.client.publish(f"uagv/v2/{MANUFACTURER}/{serial}/{topic}", payload, 0)

    def ask(self, serial: str, *actions: str):
        self.send(serial, "instantActions", {"headerId": 7, "timestamp": now(), "version": "2.1.0", "manufacturer": MANUFACTURER,
                                             "serialNumber": serial,
                                             "actions": [{"actionType": a, "actionId": f"stranger.{a}", "blockingType": "NONE"}
                                                         for a in actions]})

    def leave(self):
        self.client.disconnect()
        self.client.loop_stop()


def publish_line(port: int, *more: str, scheme: str = "mqtt") -> list[str]:
    return [str(BIN / "stepwright"), "vda5050", "publish", "--broker", f"{scheme}://127.0.0.1:{port}", *more]


class Live(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.cell = [str(CELL), f"cell.state_dir={self.folder.name}/state", f"dds.runtime_id=live-{os.getpid()}"]
        self.options = ["--config", self.cell[0]] + [word for each in self.cell[1:] for word in ("--set", each)]

    def start(self, name: str, line: list[str], **options) -> subprocess.Popen:
        with open(os.path.join(self.folder.name, name + ".log"), "ab") as log:
            process = subprocess.Popen(line, stdout=log, stderr=log, **options)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process: subprocess.Popen):
        if process.stdin:
            process.stdin.close()
        process.kill()
        process.wait()

    def log(self, name: str) -> str:
        return pathlib.Path(self.folder.name, name + ".log").read_text(encoding="utf-8")

    def arrived(self, hearing: Listener, index: int) -> bool:
        """Every vehicle has said since then that its order is done."""
        for serial in VEHICLES:
            states, orders = hearing.since(index, serial, "state"), hearing.since(index, serial, "order")
            if not states or not orders or states[-1]["orderId"] != orders[-1]["orderId"] or states[-1]["nodeStates"]:
                return False
        return True

    @staticmethod
    def tell(fleet: subprocess.Popen, line: bytes):
        fleet.stdin.write(line)
        fleet.stdin.flush()

    def test_Fleet_WhenItRuns_ThenTheBrokerHearsOrdersAndStatesThatKeepTheStandard(self):
        broker = Broker(self.folder.name)
        self.addCleanup(lambda: broker.stop())
        hearing = Listener(broker.port)
        self.addCleanup(hearing.leave)
        publisher = self.start("publisher", publish_line(broker.port, *self.options, "--visualization-every", "0.1", "--state-every", "2"))
        runtime = self.start("runtime", [str(BIN / "stepwright"), "runtime", *self.options])
        wait_until(lambda: "listens on" in self.log("runtime"), "the runtime")
        self.start("link", [str(BIN / "stepwright"), "link", *self.options])
        fleet = self.start("fleet", [FLEET, *self.cell], stdin=subprocess.PIPE)
        wait_until(lambda: all((hearing.last(v, "state") or {"orderId": ""})["orderId"] for v in VEHICLES), "orders that are taken")
        self.tell(fleet, b"go\n")
        self.asks_are_answered(hearing)
        wait_until(lambda: self.arrived(hearing, 0), "the end of the first plan")
        self.first_plan_was_said(hearing)

        self.tell(fleet, b"replan\n")
        wait_until(lambda: "plan 2" in self.log("fleet") and hearing.last("v2", "order")["orderId"].endswith(".2"), "a new order")
        hearing.lossy = True
        broker.stop()  # what is said now is lost
        time.sleep(0.3)
        index = hearing.heard()
        self.assertTrue(broker.start())
        wait_until(lambda: all(s and not s[-1]["nodeStates"] for s in (hearing.since(index, v, "state") for v in VEHICLES)),
                   "the end of the second plan")
        wait_until(lambda: all(hearing.last(v, "connection")["connectionState"] == "ONLINE" for v in VEHICLES), "connections said anew")
        for serial in VEHICLES:
            self.assertTrue(hearing.since(index, serial, "factsheet"), serial)

        publisher.send_signal(signal.SIGKILL)
        wait_until(lambda: all(hearing.last(v, "connection")["connectionState"] == "CONNECTIONBROKEN" for v in VEHICLES), "the last wills")
        self.assertIsNone(runtime.poll())
        index = hearing.heard()
        again = self.start("again", publish_line(broker.port, *self.options))
        wait_until(lambda: all(hearing.since(index, v, "state") for v in VEHICLES), "states of another publisher")
        again.send_signal(signal.SIGTERM)
        self.assertEqual(again.wait(PATIENCE_S), 0, self.log("again"))
        wait_until(lambda: all(hearing.last(v, "connection")["connectionState"] == "OFFLINE" for v in VEHICLES), "farewells")
        self.assertEqual(hearing.faults, [])
        self.assertNotRegex(self.log("publisher"), "Z error ")

    def first_plan_was_said(self, hearing: Listener):
        for serial in VEHICLES:
            orders, states = hearing.since(0, serial, "order"), hearing.since(0, serial, "state")
            self.assertEqual({o["orderId"] for o in orders if o["orderId"].endswith(".1")}, {orders[0]["orderId"]})
            self.assertEqual(hearing.held[serial]["orderId"], states[-1]["orderId"])
            self.assertTrue(all(node["released"] for node in hearing.held[serial]["nodes"]))
            self.assertGreater(len({(p["x"], p["y"]) for p in hearing.places[serial]}), 3, serial)
            goal = hearing.held[serial]["nodes"][-1]["nodePosition"]
            place = hearing.last(serial, "state")["agvPosition"]
            self.assertLess(abs(place["x"] - goal["x"]) + abs(place["y"] - goal["y"]), 0.5, serial)
        updates = sum(hearing.held[v]["orderUpdateId"] for v in VEHICLES)
        self.assertGreater(updates, 0, "nobody waited for anybody")
        statuses = [a["actionStatus"] for s in hearing.since(0, "v1", "state") for a in s["actionStates"] if a["actionType"] == "pick"]
        # It runs for 0.15 s of wall time, in which there may be no state.
        self.assertIn(list(dict.fromkeys(statuses)), (["WAITING", "RUNNING", "FINISHED"], ["WAITING", "FINISHED"]))

    def asks_are_answered(self, hearing: Listener):
        """What the cell cannot do is refused, and what it can is done."""
        index = hearing.heard()
        hearing.ask("v2", "startPause", "cancelOrder", "stateRequest", "factsheetRequest", "initPosition")
        foreign = dict(hearing.last("v3", "order"), orderId="somebody's", orderUpdateId=0)
        hearing.send("v3", "order", foreign)
        hearing.send("v3", "instantActions", b'{"headerId": 1,')

        def answers():
            states = hearing.since(index, "v2", "state")
            return {a["actionType"]: a["actionStatus"] for a in states[-1]["actionStates"] if a["actionId"].startswith("stranger.")} if states else {}

        wait_until(lambda: len(answers()) == 5, "answers")
        self.assertEqual(answers(), {"startPause": "FAILED", "cancelOrder": "FAILED", "stateRequest": "FINISHED",
                                     "factsheetRequest": "FINISHED", "initPosition": "FAILED"})
        told = {r["referenceValue"] for e in hearing.last("v2", "state")["errors"] for r in e["errorReferences"] if r["referenceKey"] == "actionId"}
        self.assertEqual(told, {"stranger.startPause", "stranger.cancelOrder", "stranger.initPosition"})
        self.assertTrue(hearing.since(index, "v2", "factsheet"))
        wait_until(lambda: {e["errorType"] for e in hearing.last("v3", "state")["errors"]} == {"orderError", "validationError"}, "refusals")
        self.assertNotEqual(hearing.last("v3", "state")["orderId"], "somebody's")

    def refused(self, *line: str, code: int = 1) -> str:
        done = subprocess.run(line, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_Publisher_WhenTheBrokerRefusesIt_ThenItSaysWhyAndEnds(self):
        folder = self.folder.name
        passwords, credentials = os.path.join(folder, "passwords"), os.path.join(folder, "credentials.toml")
        subprocess.run(["mosquitto_passwd", "-c", "-b", passwords, "fleet", "right"], check=True, capture_output=True)
        broker = Broker(folder, more=("allow_anonymous false", f"password_file {passwords}"))
        self.addCleanup(broker.stop)
        line = publish_line(broker.port, *self.options)

        def written(text: str) -> list[str]:
            pathlib.Path(credentials).write_text(text, encoding="utf-8")
            os.chmod(credentials, 0o600)
            return [*line, "--credentials", credentials]

        self.assertIn("MQ006: broker 127.0.0.1", self.refused(*line))
        self.assertIn("MQ006: broker 127.0.0.1", self.refused(*written('user = "fleet"\npassword = "wrong"\n')))
        self.assertIn(f"{credentials}:2:", self.refused(*written('user = "fleet"\npasword = "right"\n')))
        self.start("right", written('user = "fleet"\npassword = "right"\n'))
        wait_until(lambda: "connected to the broker" in self.log("right"), "a connection")

        other = [*self.options, "--broker"]
        command = line[:3]
        self.assertIn("MQ005", self.refused(*command, *other, "mqtt://no-such-host.invalid"))
        self.assertIn("MQ003", self.refused(*command, *other, "mqtt://fleet:right@127.0.0.1"))
        nobody = os.path.join(folder, "none.pem")
        self.assertIn(f"{nobody}: MQ002", self.refused(*publish_line(broker.port, *self.options, "--ca", nobody, scheme="mqtts")))
        self.assertIn("MQ007", self.refused(*publish_line(broker.port, *self.options, "--ca", credentials, scheme="mqtts")))
        self.refused(*command, *self.options, code=2)

    def test_Publisher_WhenTheBrokerComesLater_ThenItConnects(self):
        broker = Broker(self.folder.name)
        broker.stop()
        self.addCleanup(lambda: broker.stop())
        self.start("early", publish_line(broker.port, *self.options))
        wait_until(lambda: "MQ005" in self.log("early"), "the warning")
        self.assertTrue(broker.start())
        wait_until(lambda: "connected to the broker" in self.log("early"), "a connection")


if __name__ == "__main__":
    unittest.main()
