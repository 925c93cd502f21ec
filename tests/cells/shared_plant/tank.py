"""A tank with a valve and a drain as a plant of a cell, in lock-step: standard library alone.

The runtime starts it with a socket as descriptor 3 and the shared area (shared_plant.md) as descriptor 4.
"""

import mmap
import random
import socket
import struct
import sys

MAGIC, VERSION = b"SWPLANT1", 1
STEP, TIME, STEP_LENGTH = 64, 72, 80             # what is asked for (u64, i64 ns, i64 ns)
PEER_VERSION, STATUS, DONE, MESSAGE = 128, 132, 136, 144

runtime = socket.socket(fileno=3)
area = memoryview(mmap.mmap(4, 0))
magic, version, size, *places, seed = struct.unpack_from("<8sII10IQ", area, 0)
if magic != MAGIC or version != VERSION or size > len(area):
    sys.exit(f"no area of version {VERSION}: {magic}, version {version}, {len(area)} bytes")

lines = bytes(area[places[9]:places[9] + places[8]]).decode().splitlines()
where = {}                                       # (kind, name) -> block, index
for number, kind in enumerate(("actuator", "sensor", "value", "fault")):
    count, at = places[2 * number:2 * number + 2]
    block = area[at:at + 8 * count].cast("d")    # a list of floats that both sides see
    names = [line.split(" ", 1)[1] for line in lines if line.startswith(kind + " ")]
    where.update({(kind, name): (block, index) for index, name in enumerate(names)})


def get(kind, name):
    block, index = where[kind, name]
    return block[index]


def put(kind, name, number):
    block, index = where[kind, name]
    block[index] = number


def answer(failed=""):
    """The step is done, or why it cannot be."""
    area[MESSAGE:MESSAGE + len(failed) + 1] = failed.encode("ascii", "replace") + b"\0"
    struct.pack_into("<II", area, PEER_VERSION, VERSION, 1 if failed else 0)
    area[DONE:DONE + 8] = area[STEP:STEP + 8]
    runtime.send(b"r")


level_m, noise = 0.2, random.Random(seed)        # the same seed draws the same noise
put("sensor", "level", level_m)
answer()                                         # ready, with the sensors of the beginning
while runtime.recv(1):                           # nothing more: the runtime has ended
    seconds = struct.unpack_from("<q", area, STEP_LENGTH)[0] * 1e-9
    inflow = 0.02 * get("actuator", "valve")     # m/s
    outflow = 0.01 * get("actuator", "drain") + get("fault", "leak")
    level_m = min(max(level_m + (inflow - outflow) * seconds, 0.0), 2.0)
    put("sensor", "level", level_m + noise.gauss(0.0, 0.0005))
    put("sensor", "full", level_m >= 1.9)
    put("value", "volume", 500 * level_m)
    answer()
