"""Vehicles of VDA 5050 over paho-mqtt: another implementation of the vehicle's side, judged by jsonschema.

A vehicle takes orders and updates by the standard's rules, passes one released node with each tick and says its
state. What is wrong with a message of the master control is kept in `faults`.
"""

import datetime
import json
import threading

import paho.mqtt.client as mqtt

MANUFACTURER = "Stepwright"


def now() -> str:
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%S.%f")[:-3] + "Z"


class Vehicle:
    def __init__(self, serial: str, port: int, judges: dict, lost_cancels: int = 0):
        """`lost_cancels`: so many cancelOrders do not come through."""
        self.serial, self.judges, self.faults = serial, judges, []
        self.lost_cancels, self.cancels, self.instants = lost_cancels, [], []
        self.lock = threading.Lock()
        self.order, self.passed, self.updates, self.repeats = None, -1, 0, 0
        self.counts: dict[str, int] = {}
        self.client = mqtt.Client(client_id=f"vehicle-{serial}")
        self.client.reconnect_delay_set(1, 1)
        self.client.will_set(self.topic("connection"), self.message("connection", connectionState="CONNECTIONBROKEN"), 1, True)
        self.client.on_connect = self.on_connect
        self.client.on_message = self.on_message
        self.client.connect("127.0.0.1", port, 15)
        self.client.loop_start()

    def topic(self, name: str) -> str:
        return f"uagv/v2/{MANUFACTURER}/{self.serial}/{name}"

    def message(self, name: str, **members) -> str:
        number = self.counts.get(name, 0)
        self.counts[name] = number + 1
        return json.dumps({"headerId": number, "timestamp": now(), "version": "2.1.0", "manufacturer": MANUFACTURER,
                           "serialNumber": self.serial, **members})

    def on_connect(self, client, _data, _flags, code):
        if code != 0:
            return
        client.subscribe([(self.topic("order"), 0), (self.topic("instantActions"), 0)])
        client.publish(self.topic("connection"), self.message("connection", connectionState="ONLINE"), 1, True)

    def on_message(self, _client, _data, message):
        with self.lock:
            order = json.loads(message.payload)
            if message.topic.endswith("/instantActions"):
                self.take_actions(order)
                return
            for error in self.judges["order"].iter_errors(order):
                self.faults.append(f"{self.serial}: {error.message}")
            if message.retain or message.qos != 0:
                self.faults.append(f"{self.serial}: an order is retained or not QoS 0")
            self.take(order)

    def take_actions(self, message: dict):
        for action in message["actions"]:
            self.cancels.append(action["actionId"])
            if len(self.cancels) <= self.lost_cancels:
                continue
            self.order, self.passed = None, -1
            self.instants = [{"actionId": action["actionId"], "actionType": action["actionType"], "actionStatus": "FINISHED"}]

    def take(self, order: dict):
        """Figure 8 of the standard."""
        if self.order is None:
            if order["orderUpdateId"] != 0:
                return  # its first message was lost: it will come again
            self.order, self.passed = order, -1
            return
        if order["orderId"] != self.order["orderId"]:
            self.faults.append(f"{self.serial}: another order before the end of the first")
            return
        if order["orderUpdateId"] <= self.order["orderUpdateId"]:
            self.repeats += 1
            return
        end = self.decision()
        nodes, edges = self.order["nodes"], self.order["edges"]
        if order["nodes"][0]["nodeId"] != nodes[end]["nodeId"] or order["nodes"][0]["sequenceId"] != nodes[end]["sequenceId"]:
            return  # an update before it was lost: both will come again
        if order["nodes"][0] != nodes[end]:
            self.faults.append(f"{self.serial}: the stitching node has changed")
        self.order["nodes"] = nodes[: end + 1] + order["nodes"][1:]
        self.order["edges"] = edges[:end] + order["edges"]
        self.order["orderUpdateId"] = order["orderUpdateId"]
        self.updates += 1

    def decision(self) -> int:
        return max(k for k, node in enumerate(self.order["nodes"]) if node["released"])

    def tick(self):
        with self.lock:
            if self.order is not None and self.passed < self.decision():
                self.passed += 1
            text = self.message("state", **self.state())
        self.client.publish(self.topic("state"), text, 0)

    def state(self) -> dict:
        nodes = self.order["nodes"] if self.order else []
        edges = self.order["edges"] if self.order else []
        last = nodes[self.passed] if self.passed >= 0 else {"nodeId": "", "sequenceId": 0}
        part = lambda item, name: {name: item[name], "sequenceId": item["sequenceId"], "released": item["released"]}
        actions = [a for node in nodes[: self.passed + 1] for a in node["actions"]]
        return {"orderId": self.order["orderId"] if self.order else "",
                "orderUpdateId": self.order["orderUpdateId"] if self.order else 0,
                "lastNodeId": last["nodeId"], "lastNodeSequenceId": last["sequenceId"], "driving": False,
                "operatingMode": "AUTOMATIC", "nodeStates": [part(n, "nodeId") for n in nodes[self.passed + 1 :]],
                "edgeStates": [part(e, "edgeId") for e in edges[max(self.passed, 0) :]],
                "actionStates": [{"actionId": a["actionId"], "actionStatus": "FINISHED"} for a in actions] + self.instants,
                "batteryState": {"batteryCharge": 80.0, "charging": False}, "errors": [],
                "safetyState": {"eStop": "NONE", "fieldViolation": False}}

    def arrived(self) -> bool:
        with self.lock:
            return self.order is not None and self.passed + 1 == len(self.order["nodes"])

    def leave(self):
        self.client.publish(self.topic("connection"), self.message("connection", connectionState="OFFLINE"), 1, True).wait_for_publish(5)
        self.client.disconnect()
        self.client.loop_stop()

    def vanish(self):
        """The connection breaks: no farewell."""
        self.client.on_connect = None
        self.client.loop_stop(force=True)
        self.client.socket().close()
