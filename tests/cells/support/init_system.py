"""The end of the notify protocol that systemd has, for tests of processes that speak the other."""

import os
import re
import socket
import time

from processes import eventually

WATCHDOG_USEC = 400_000


class InitSystem:
    """The end of the notify protocol that systemd has."""

    def __init__(self, folder, watchdog=True):
        self.path = str(folder / "notify")
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(self.path)
        self.socket.settimeout(0.05)
        self.environment = {**os.environ, "NOTIFY_SOCKET": self.path}
        if watchdog:
            self.environment["WATCHDOG_USEC"] = str(WATCHDOG_USEC)
        self.messages = []

    def listen(self, seconds=0.0):
        """Takes what came, and what comes within the time; all of it so far."""
        deadline = time.monotonic() + seconds
        while True:
            try:
                self.messages.append(self.socket.recv(4096).decode())
            except TimeoutError:
                if time.monotonic() >= deadline:
                    return self.messages

    def heard(self, pattern):
        return eventually(lambda: any(re.search(pattern, each) for each in self.listen()), pause_s=0.0)

    def beats(self, seconds):
        """How often the watchdog is fed in so many seconds from now."""
        self.listen()
        before = len(self.messages)
        self.listen(seconds)
        return self.messages[before:].count("WATCHDOG=1")

    def close(self):
        self.socket.close()
