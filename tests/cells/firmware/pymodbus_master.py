"""pymodbus as the master of a board that runs the counting program of board_test.cpp. Prints what is wrong."""

import sys

from pymodbus.client import ModbusSerialClient
from pymodbus.register_read_message import ReadWriteMultipleRegistersRequest

client = ModbusSerialClient(sys.argv[1], baudrate=115200, timeout=60)
problems = []


def expect(what, found, wanted):
    if found != wanted:
        problems.append(f"{what}: {found} instead of {wanted}")


client.connect()
expect("magic", client.read_holding_registers(0xF000, 2, slave=1).registers, [0x5357, 2])
client.write_registers(0xF200, [1, 0x3C00], slave=1)
expect("coils", client.read_coils(0, 8, slave=1).bits[:8], [bool(0x3C >> i & 1) for i in range(8)])
expect("discrete inputs", client.read_discrete_inputs(2, 4, slave=1).bits[:4], [True] * 4)
expect("output register", client.read_holding_registers(0, 2, slave=1).registers, [0x003C, 1])
expect("input register", client.read_input_registers(0, 1, slave=1).registers, [0x003C])
client.write_register(1024, 0x1234, slave=1)
client.mask_write_register(1024, 0xFF00, 0x0056, slave=1)
expect("marker", client.read_holding_registers(1024, 1, slave=1).registers, [0x1256])
# pymodbus 3.0.0 forgets the slave of this request.
request = ReadWriteMultipleRegistersRequest(read_address=0xF280, read_count=6, write_address=0xF200, write_registers=[2, 0])
request.unit_id = 1
expect("turn, state and scan", client.execute(request).registers, [2, 2, 0, 0, 0, 2])
client.write_coils(0, [True, False, True], slave=1)
expect("written coils", client.read_coils(0, 3, slave=1).bits[:3], [True, False, True])
expect("exception", client.read_holding_registers(0x9000, 1, slave=1).exception_code, 2)
client.close()
print("\n".join(problems) or "all as expected")
