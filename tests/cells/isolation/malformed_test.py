"""A corpus of malformed RTPS frames against link, page and supervisor: any of them may die and be started again; the
runtime keeps scanning, and its memory stays what it was."""

import os
import random
import socket
import subprocess
import time
import unittest

from disturbance import no_worse, watch
from namespaces import need_network_of_its_own
from processes import NO_PLANT, PATIENCE_S, TESTS, Cell, Process, eventually
from rtps import HEADER, PREFIX, capture, corpus, mutated, ports

REAL = NO_PLANT + '[clock]\nmode = "real"\n[hmi]\nport = 0\n'
MUTATIONS = 20_000
QUIET_S = 1.0  # only its memory is read
ABUSE_S = 20.0
SEED = int(os.environ.get("SEED", "1"))
READY = {"link": "connected", "hmi": "at http"}
# As the units have it: a frame that makes a process take memory must not take the machine's, nor its death a core.
MEMORY = ("prlimit", f"--data={256 << 20}", "--core=0")


class Malformed(unittest.TestCase):
    def setUp(self):
        need_network_of_its_own()
        self.cell = Cell(REAL, domain=4)
        self.addCleanup(self.cell.__exit__)
        self.deaths = {}  # by process

    def attend(self):
        """The supervisor's end of Fast DDS."""
        process = Process([*MEMORY, TESTS / "cells_attend", str(self.cell.domain), "127.0.0.1", "0", self.cell.name],
                          self.cell.folder / f"attend{time.monotonic_ns()}.log", stdin=subprocess.PIPE)
        self.cell.processes.append(process)
        return process

    def start(self, name):
        if name == "attend":
            return self.attend()
        self.cell.prefix = list(MEMORY)
        process = self.cell.start(name)
        self.cell.prefix = []
        return process

    def keep_alive(self, members):
        """Starts again who died, as its unit would, and waits until it can be attacked."""
        for name, process in members.items():
            if process.running():
                continue
            self.deaths[name] = self.deaths.get(name, 0) + 1
            process.end()
            self.cell.processes.remove(process)
            members[name] = self.start(name)
            if name in READY:
                members[name].wait_for(READY[name])

    def send(self, packets, members, seconds):
        """As many as the time allows, from one end to the other; how many there were."""
        out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        targets = [("127.0.0.1", port) for port in ports(self.cell.domain, 4)]
        deadline = time.monotonic() + seconds
        sent = 0
        for number, packet in enumerate(packets):
            for target in targets:
                try:
                    out.sendto(packet, target)
                except OSError:  # nobody listens there just now
                    pass
            sent += 1
            if number % 20 == 0:
                time.sleep(0.001)  # lets them read: a packet that was dropped proves nothing
                self.keep_alive(members)
                if time.monotonic() > deadline:
                    break
        out.close()
        return sent

    def test_the_corpus(self):
        self.cell.start_runtime()
        self.cell.load(1_000)
        quiet = watch(self.cell, lambda: time.sleep(QUIET_S))
        members = {name: self.start(name) for name in ("link", "hmi", "attend")}
        members["link"].wait_for("connected")
        members["attend"].wait_for("running", PATIENCE_S)
        self.assertTrue(all(process.running() for process in members.values()))
        real = capture(2_000, 3.0)
        self.assertGreater(len(real), 50)
        prefixes = sorted({packet[8:20] for packet in real})
        self.assertGreaterEqual(len(prefixes), 3)
        self.assertTrue(real[0].startswith(HEADER[:5]))
        sent = {}

        def abuse():
            # In a random order that can be repeated: every kind has its turn, whatever the time allows.
            chance = random.Random(SEED)
            made = list(corpus([PREFIX, *prefixes[:3]]))
            chance.shuffle(made)
            sent["made by hand"] = self.send(made, members, ABUSE_S)
            sent["mutations"] = self.send(mutated(real, MUTATIONS, SEED), members, ABUSE_S)

        abused = watch(self.cell, abuse)
        print(f"\n  sent: {sent}\n  deaths: {self.deaths or 'none'}")
        self.assertGreater(sent["made by hand"], 500)
        self.assertGreater(sent["mutations"], 500)
        no_worse(self, quiet, abused)
        # Whoever lives or was started again still works, or does after a restart, as its unit would bring it.
        for process in members.values():
            process.end()
        link = self.start("link")
        link.wait_for("connected")
        self.assertTrue(self.attend().wait_for("running"))
        self.assertTrue(eventually(lambda: self.cell.figure("stepwright_scans_total") > 1_000))


if __name__ == "__main__":
    unittest.main()
