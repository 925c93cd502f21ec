"""pymodbus's server without its sockets: each request of a file through its decoder and its datastore.

pymodbus_peer.py BITS REGISTERS REQUESTS ANSWERS: a request is a line of hex (the PDU); an answer is a line "a PDU
changes", "s - " (nothing is sent) or "r - " (it raises while it decodes: the server closes the connection).
"""

import logging
import sys

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusSlaveContext
from pymodbus.device import ModbusControlBlock
from pymodbus.exceptions import ModbusException
from pymodbus.factory import ServerDecoder
from pymodbus.pdu import ModbusExceptions

logging.disable(logging.CRITICAL)


def bit_at(index, table):
    return ((((index + table) * 2654435761) & 0xFFFFFFFF) >> 13) & 1


def register_at(index, table):
    return (index * 40503 + table * 12345 + 0x55AA) & 0xFFFF


class Block(ModbusSequentialDataBlock):
    """A table that knows what was changed in it, and takes it back."""

    def __init__(self, letter, values):
        super().__init__(0, values)
        self.letter = letter
        self.touched = {}

    def setValues(self, address, values):  # pylint: disable=invalid-name
        for index in range(address, address + len(values)):
            self.touched.setdefault(index, self.values[index])
        super().setValues(address, values)

    def take_changes(self):
        found = []
        for index, before in sorted(self.touched.items()):
            now = self.values[index]
            if int(now) != int(before):
                found.append(f"{self.letter}{index}={int(now) if self.letter in 'cd' else format(now, '04x')}")
            self.values[index] = before
        self.touched = {}
        return found


def identify():
    """As our_peer.cpp identifies itself."""
    identity = ModbusControlBlock().Identity
    identity.VendorName = "Stepwright"
    identity.ProductCode = "oracle"
    identity.MajorMinorRevision = "1.0"
    identity.VendorUrl = ""
    identity.ProductName = ""
    identity.ModelName = ""
    identity.UserApplicationName = ""


def answer(decoder, context, pdu):
    """As ModbusBaseRequestHandler.execute of async_io.py does it."""
    try:
        request = decoder.decode(pdu)
    except Exception:  # pylint: disable=broad-except
        return "r", None
    if request is None:
        return "r", None
    try:
        response = request.execute(context)
    except Exception:  # pylint: disable=broad-except
        response = request.doException(ModbusExceptions.SlaveFailure)
    if not response.should_respond:
        return "s", None
    try:
        return "a", bytes([response.function_code & 0xFF]) + response.encode()
    except Exception:  # pylint: disable=broad-except
        return "r", None


def main():
    bits, registers = int(sys.argv[1]), int(sys.argv[2])
    blocks = [Block("c", [bit_at(i, 0) for i in range(bits)]), Block("d", [bit_at(i, 1) for i in range(bits)]),
              Block("h", [register_at(i, 2) for i in range(registers)]),
              Block("i", [register_at(i, 3) for i in range(registers)])]
    context = ModbusSlaveContext(co=blocks[0], di=blocks[1], hr=blocks[2], ir=blocks[3], zero_mode=True)
    decoder = ServerDecoder()
    identify()
    with open(sys.argv[3], encoding="ascii") as asked, open(sys.argv[4], "w", encoding="ascii") as answered:
        for line in asked:
            reaction, pdu = answer(decoder, context, bytes.fromhex(line.strip()))
            changed = [each for block in blocks for each in block.take_changes()]
            answered.write(f"{reaction} {pdu.hex() if pdu else '-'} {' '.join(changed)}\n")


if __name__ == "__main__":
    main()
