"""Fast DDS uses the interfaces that the configuration lists, and no others: loopback by default."""

import ipaddress
import time
import unittest

from namespaces import Network, udp_addresses
from processes import NO_PLANT, PATIENCE_S, Cell

HOST = "10.77.1.1"
MORE = NO_PLANT + "[hmi]\nport = 0\n"
LOOPBACK = ipaddress.ip_address("127.0.0.1")


def awaited_addresses(pid):
    """Once there are any: a process may say where its page is before it has joined the others."""
    deadline = time.monotonic() + PATIENCE_S
    while not (found := udp_addresses(pid)) and time.monotonic() < deadline:
        time.sleep(0.1)
    return found


class Interfaces(unittest.TestCase):
    def setUp(self):
        self.network = Network({"a": HOST})
        self.addCleanup(self.network.close)

    def start(self, dds):
        cell = Cell(MORE, domain=5, dds=dds, prefix=self.network.prefix("a"))
        self.addCleanup(cell.__exit__)
        cell.start_runtime()
        link, page = cell.start("link"), cell.start("hmi")
        link.wait_for("connected")
        page.wait_for("at http")
        return cell, link, page

    def test_by_default_nothing_listens_beyond_loopback(self):
        for process in self.start("")[1:]:
            addresses = awaited_addresses(process.pid)
            self.assertTrue(addresses)
            self.assertEqual({address for address, _ in addresses}, {LOOPBACK}, addresses)

    def test_a_listed_interface_is_used_and_no_other(self):
        for process in self.start(f'interfaces = ["{HOST}"]\n')[1:]:
            addresses = {address for address, _ in awaited_addresses(process.pid)}
            self.assertIn(ipaddress.ip_address(HOST), addresses)
            self.assertNotIn(LOOPBACK, addresses)
            self.assertFalse({each for each in addresses if each.is_unspecified}, addresses)

    def test_the_scan_process_has_no_such_socket_at_all(self):
        cell = self.start(f'interfaces = ["{HOST}"]\n')[0]
        self.assertEqual(udp_addresses(cell.processes[0].pid), set())

    def test_an_address_of_another_machine_is_refused(self):
        cell = Cell(MORE, domain=5, dds='interfaces = ["10.77.1.9"]\n', prefix=self.network.prefix("a"))
        self.addCleanup(cell.__exit__)
        for command in ("link", "hmi"):
            process = cell.start(command)
            self.assertIn(process.wait(), (1, 5))
            self.assertIn("D0006: no interface of this machine has the address 10.77.1.9", process.output())
            self.assertIn(HOST, process.output().split("hint", 1)[1])


if __name__ == "__main__":
    unittest.main()
