#!/usr/bin/python3
"""A physical PLC as pymodbus serves it, over TCP or on a serial line. Its process: input register 0 is half of holding
register 0, discrete input 0 repeats coil 0.

    pymodbus_plc.py tcp 1502 [UNIT...]        pymodbus_plc.py line /dev/pts/3 [UNIT...]
"""

import sys

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.framer.rtu_framer import ModbusRtuFramer
from pymodbus.server import StartSerialServer, StartTcpServer

SIZE = 100


class Follower(ModbusSequentialDataBlock):
    """A block whose first value follows that of another block."""

    def __init__(self, leader, rule):
        super().__init__(0, [0] * SIZE)
        self.leader = leader
        self.rule = rule

    def getValues(self, address, count=1):  # noqa: N802 (the name is pymodbus's)
        self.values[0] = self.rule(self.leader.getValues(0, 1)[0])
        return super().getValues(address, count)


def plc():
    coils = ModbusSequentialDataBlock(0, [0] * SIZE)
    holding = ModbusSequentialDataBlock(0, [0] * SIZE)
    return ModbusSlaveContext(co=coils, hr=holding, di=Follower(coils, lambda value: value),
                              ir=Follower(holding, lambda value: value // 2), zero_mode=True)


def main():
    kind, where, *units = sys.argv[1:]
    context = ModbusServerContext(slaves={int(unit): plc() for unit in units or ["1"]}, single=False)
    print(f"PLC at {where}", flush=True)
    if kind == "tcp":
        # A PLC that was killed leaves connections that the kernel still closes; its port is taken again all the same. pymodbus
        # does not ask for that by itself, and keeps to itself that it could not listen.
        StartTcpServer(context=context, address=("127.0.0.1", int(where)), allow_reuse_address=True, ignore_missing_slaves=True)
    else:
        # A pseudo terminal has no parity. pyserial asks for its settings twice, and is refused the second time if parity
        # is among them and nothing else has changed; pymodbus keeps that to itself and then never answers.
        StartSerialServer(context=context, framer=ModbusRtuFramer, port=where, baudrate=19200, parity="N",
                          ignore_missing_slaves=True)


if __name__ == "__main__":
    main()
