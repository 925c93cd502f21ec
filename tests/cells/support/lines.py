"""Pairs of serial lines without wires, for tests: what goes into one end comes out of the other."""

import os
import select
import struct
import subprocess
import threading
import tty

from processes import eventually


class Line:
    """socat's pair of pseudo terminals: Line(folder) has two ends, `slave` and `master`."""

    def __init__(self, folder, name="line"):
        self.slave, self.master = folder / f"{name}-slave", folder / f"{name}-master"
        self.process = subprocess.Popen(["socat", f"pty,raw,echo=0,link={self.slave}", f"pty,raw,echo=0,link={self.master}"])
        assert eventually(lambda: self.slave.exists() and self.master.exists()), "socat made no line"

    def close(self):
        self.process.terminate()
        self.process.wait()


class TappedLine:
    """The same, with a look at what goes over it: `frames` are (from the master?, bytes), as the direction changes."""

    def __init__(self):
        pairs = [os.openpty(), os.openpty()]  # (ours, theirs)
        self.ours = [pair[0] for pair in pairs]
        self.theirs = [pair[1] for pair in pairs]  # kept open, so that a client may come and go
        for each in self.theirs:
            tty.setraw(each)
        self.slave, self.master = (os.ttyname(each) for each in self.theirs)
        self.frames = []
        self.stop, self.stopped = os.pipe()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        while True:
            ready, _, _ = select.select([*self.ours, self.stop], [], [])
            if self.stop in ready:
                return
            for end in ready:
                data = os.read(end, 4096)
                from_master = end == self.ours[1]
                if self.frames and self.frames[-1][0] == from_master:
                    self.frames[-1] = (from_master, self.frames[-1][1] + data)
                else:
                    self.frames.append((from_master, data))
                os.write(self.ours[0] if from_master else self.ours[1], data)

    def close(self):
        if self.thread.is_alive():
            os.write(self.stopped, b"!")
            self.thread.join()
            for each in (*self.ours, *self.theirs, self.stop, self.stopped):
                os.close(each)

    def write_capture(self, file, port):
        """The frames as a capture of UDP between `port` (the slave) and another, which tshark can take for Modbus RTU."""
        raw_ip = 101
        with open(file, "wb") as out:
            out.write(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, raw_ip))
            for number, (from_master, frame) in enumerate(self.frames):
                ports = (40000, port) if from_master else (port, 40000)
                datagram = struct.pack(">HHHH", *ports, 8 + len(frame), 0) + frame
                address = b"\x7f\x00\x00\x01"
                packet = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(datagram), number & 0xFFFF, 0, 64, 17, 0, address,
                                     address) + datagram
                out.write(struct.pack("<IIII", number, 0, len(packet), len(packet)) + packet)
