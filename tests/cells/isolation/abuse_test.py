"""Whatever is done to the link process and to the ports of Fast DDS, the scan in real time does not notice."""

import os
import signal
import socket
import subprocess
import time
import unittest

from disturbance import no_worse, watch
from namespaces import need_network_of_its_own
from processes import NO_PLANT, PATIENCE_S, TESTS, Cell, eventually
from rtps import ports

REAL = NO_PLANT + '[clock]\nmode = "real"\n'
STRETCH_S = 5.0
QUIET_S = 1.0  # only its memory is read


class Abuse(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """One runtime for all of them: what one of them does to it, the next would see."""
        need_network_of_its_own()
        cls.cell = Cell(REAL, domain=3)
        cls.addClassCleanup(cls.cell.__exit__)
        cls.runtime = cls.cell.start_runtime()
        cls.cell.load(1_000)
        assert eventually(lambda: cls.cell.figure("stepwright_scans_total") > 1_000)
        cls.quiet = watch(cls.cell, lambda: time.sleep(QUIET_S))

    def setUp(self):
        links = len(self.cell.processes)
        self.addCleanup(lambda: [process.end() for process in self.cell.processes[links:]])

    def link(self):
        link = self.cell.start("link")
        link.wait_for("connected")
        return link

    def test_a_link_that_is_killed_again_and_again(self):
        killed = 0

        def kill():
            nonlocal killed
            deadline = time.monotonic() + STRETCH_S
            while time.monotonic() < deadline:
                self.link().end(signal.SIGKILL)
                killed += 1

        abused = watch(self.cell, kill)
        print(f"\n  {killed} links were killed")
        self.assertGreater(killed, 3)
        no_worse(self, self.quiet, abused)
        self.link()

    def test_a_flood_of_the_ports_of_the_link(self):
        link = self.link()
        sent = 0

        def flood():
            nonlocal sent
            out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            packets = [b"RTPS" + os.urandom(size) for size in (16, 200, 1_400, 60_000)]
            targets = [("127.0.0.1", port) for port in ports(self.cell.domain, 2)]
            deadline = time.monotonic() + STRETCH_S
            while time.monotonic() < deadline:
                for target in targets:
                    for packet in packets:
                        try:
                            out.sendto(packet, target)
                            sent += 1
                        except OSError:  # nobody listens there
                            pass
            out.close()

        abused = watch(self.cell, flood)
        print(f"\n  {sent} datagrams were sent")
        self.assertGreater(sent, 10_000)
        no_worse(self, self.quiet, abused)
        if link.running():
            link.end()
        self.link()

    def test_the_measure_sees_a_scan_that_is_disturbed(self):
        def stop():
            for _ in range(5):
                time.sleep(STRETCH_S / 10)
                self.runtime.send(signal.SIGSTOP)
                time.sleep(STRETCH_S / 10)
                self.runtime.send(signal.SIGCONT)

        disturbed = watch(self.cell, stop)
        with self.assertRaises(AssertionError):
            no_worse(self, self.quiet, disturbed)

    def test_a_crowd_at_the_service_socket(self):
        def crowd():
            deadline = time.monotonic() + STRETCH_S
            while time.monotonic() < deadline:
                clients = []
                for _ in range(40):  # more than are let in
                    client = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
                    client.settimeout(0.2)
                    try:
                        client.connect(str(self.cell.socket))
                        client.sendall(os.urandom(64))
                    except OSError:
                        pass
                    clients.append(client)
                for client in clients:
                    client.close()
                subprocess.run([TESTS / "cells_load", self.cell.socket, "1000", "damaged"], capture_output=True,
                               check=False, timeout=PATIENCE_S)

        no_worse(self, self.quiet, watch(self.cell, crowd))


if __name__ == "__main__":
    unittest.main()
