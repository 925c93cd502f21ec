"""Network namespaces of a test's own, and what they show of sockets."""

import ctypes
import ipaddress
import os
import pathlib
import subprocess
import unittest

CLONE_NEWNET = 0x40000000
_alone = None


def ip(*arguments):
    subprocess.run(["ip", *map(str, arguments)], check=True, capture_output=True, text=True)


def need_network_of_its_own():
    """Puts this process, once, into a network namespace with a loopback interface and nothing else."""
    global _alone
    if _alone is None:
        libc = ctypes.CDLL(None, use_errno=True)
        _alone = libc.unshare(CLONE_NEWNET) == 0
        if _alone:
            ip("link", "set", "lo", "up")
    if not _alone:
        raise unittest.SkipTest("this test needs a network namespace of its own, which only root may make")


def udp_addresses(pid):
    """(address, port) of every UDP socket in the network namespace of a process that is the process's own."""
    inodes = set()
    for entry in pathlib.Path(f"/proc/{pid}/fd").iterdir():
        try:
            target = os.readlink(entry)
        except OSError:
            continue
        if target.startswith("socket:["):
            inodes.add(target[8:-1])
    found = set()
    for table in ("udp", "udp6"):
        for line in pathlib.Path(f"/proc/{pid}/net/{table}").read_text(encoding="ascii").splitlines()[1:]:
            fields = line.split()
            if fields[9] not in inodes:
                continue
            address, port = fields[1].split(":")
            raw = b"".join(bytes.fromhex(address[i:i + 8])[::-1] for i in range(0, len(address), 8))
            found.add((ipaddress.ip_address(raw), int(port, 16)))
    return found


class Network:
    """Namespaces that a bridge joins: Network({"a": "10.77.0.1", "b": "10.77.0.2"})."""

    def __init__(self, members):
        self.members = members
        self.names = {each: f"sw{each}{os.getpid()}" for each in (*members, "x")}
        try:
            for name in self.names.values():
                ip("netns", "add", name)
        except (subprocess.CalledProcessError, FileNotFoundError) as refused:
            self.close()
            raise unittest.SkipTest(f"this test needs `ip netns add`: {getattr(refused, 'stderr', refused)}") from refused
        hub = self.names["x"]
        ip("-n", hub, "link", "add", "br0", "type", "bridge", "mcast_snooping", 0)
        ip("-n", hub, "link", "set", "br0", "up")
        for each, address in members.items():
            name = self.names[each]
            ip("-n", name, "link", "add", "eth0", "type", "veth", "peer", "name", f"to-{each}", "netns", hub)
            ip("-n", name, "addr", "add", f"{address}/24", "dev", "eth0")
            ip("-n", name, "link", "set", "lo", "up")
            ip("-n", name, "link", "set", "eth0", "up")
            ip("-n", hub, "link", "set", f"to-{each}", "master", "br0")
            ip("-n", hub, "link", "set", f"to-{each}", "up")

    def prefix(self, each):
        """What runs a command in the namespace of a member."""
        return ("ip", "netns", "exec", self.names[each])

    def cable(self, each, plugged):
        ip("-n", self.names["x"], "link", "set", f"to-{each}", "up" if plugged else "down")

    def close(self):
        for name in self.names.values():
            subprocess.run(["ip", "netns", "del", name], capture_output=True, check=False)
