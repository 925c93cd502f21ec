"""pymodbus's server as a slave for our master: peer_server.py tcp PORT | rtu DEVICE. Says 'ready' when it listens."""

import asyncio
import logging
import sys

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server.async_io import ModbusSerialServer, ModbusTcpServer
from pymodbus.transaction import ModbusRtuFramer, ModbusSocketFramer

logging.disable(logging.CRITICAL)
COUNT = 200


def context():
    """Tables as every peer of this folder has them."""
    slave = ModbusSlaveContext(zero_mode=True,
                               co=ModbusSequentialDataBlock(0, [0] * COUNT),
                               di=ModbusSequentialDataBlock(0, [int(i % 3 == 0) for i in range(COUNT)]),
                               hr=ModbusSequentialDataBlock(0, [0] * COUNT),
                               ir=ModbusSequentialDataBlock(0, [3 * i + 7 for i in range(COUNT)]))
    return ModbusServerContext(slaves={1: slave}, single=False)


async def listens(port):
    while True:
        try:
            (await asyncio.open_connection("127.0.0.1", port))[1].close()
            return
        except OSError:
            await asyncio.sleep(0.02)


async def main():
    kind, where = sys.argv[1:3]
    if kind == "tcp":
        server = ModbusTcpServer(context(), framer=ModbusSocketFramer, address=("127.0.0.1", int(where)))
        serving = asyncio.ensure_future(server.serve_forever())
        await listens(int(where))
    else:
        server = ModbusSerialServer(context(), framer=ModbusRtuFramer, port=where, baudrate=19200, parity="N", stopbits=1,
                                    timeout=1)
        await server.start()
        serving = asyncio.ensure_future(server.serve_forever())
    print("ready", flush=True)
    await serving


asyncio.run(main())
