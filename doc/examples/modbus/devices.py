#!/usr/bin/env python3
"""Two devices to play with, as pymodbus (3.0 to 3.9) serves them: a tank at port 1502, a pump's drive at port 1503.

tank    input register 0: level, 0 to 1000 tenths of a percent; coil 0: inlet valve
drive   holding register 0: wanted speed, 0 to 1500 per minute; input register 0: real speed; discrete input 0: trouble
"""

import asyncio
import logging

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartAsyncTcpServer

logging.disable(logging.CRITICAL)
STEP_S = 0.05
COILS, DISCRETE, HOLDING, INPUT = 1, 2, 3, 4  # the functions that read them


def device():
    block = lambda: ModbusSequentialDataBlock(0, [0] * 16)
    return ModbusSlaveContext(zero_mode=True, co=block(), di=block(), hr=block(), ir=block())


async def plant(tank, drive):
    """The valve fills the tank, the pump empties it; the drive needs two seconds for its full speed."""
    level, speed = 500.0, 0.0
    while True:
        valve = tank.getValues(COILS, 0)[0]
        wanted = min(drive.getValues(HOLDING, 0)[0], 1500)
        speed += max(-40.0, min(40.0, wanted - speed))
        level += (2.0 if valve else 0.0) - 2.0 * speed / 1500.0
        level = max(0.0, min(1000.0, level))
        tank.setValues(INPUT, 0, [round(level)])
        drive.setValues(INPUT, 0, [round(speed)])
        await asyncio.sleep(STEP_S)


async def main():
    tank, drive = device(), device()
    serve = lambda each, port: StartAsyncTcpServer(ModbusServerContext(slaves=each, single=True), address=("127.0.0.1", port))
    await asyncio.gather(plant(tank, drive), serve(tank, 1502), serve(drive, 1503))


asyncio.run(main())
