"""pymodbus's client against a slave with the tables of this folder: peer_client.py tcp PORT | rtu DEVICE | tls PORT.
Prints a JSON object: for each function code "ok", or what else it came to."""

import json
import logging
import sys

from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from pymodbus.mei_message import ReadDeviceInformationRequest

logging.disable(logging.CRITICAL)
PATTERN = [True, False, True, True, False, False, False, True, True, True]
WORDS = [0x1234, 0xFFFF, 0, 0x8001]


def client_of(kind, where):
    if kind == "tcp":
        return ModbusTcpClient("127.0.0.1", port=int(where), timeout=600)
    return ModbusSerialClient(where, baudrate=19200, parity="N", stopbits=1, timeout=600)


def main():
    kind, where = sys.argv[1:3]
    client = client_of(kind, where)
    assert client.connect()
    found = {}

    def tell(name, response, good=lambda _: True):
        if response.isError():
            found[name] = f"exception {getattr(response, 'exception_code', response)}"
        else:
            found[name] = "ok" if good(response) else f"wrong: {vars(response)}"

    tell("FC15", client.write_coils(3, PATTERN, slave=1))
    tell("FC5", client.write_coil(14, True, slave=1))
    tell("FC1", client.read_coils(0, 19, slave=1), lambda r: r.bits[3:13] == PATTERN and r.bits[14] and not r.bits[0])
    tell("FC2", client.read_discrete_inputs(1, 19, slave=1),
         lambda r: r.bits[:19] == [i % 3 == 0 for i in range(1, 20)])
    tell("FC16", client.write_registers(10, WORDS, slave=1))
    tell("FC6", client.write_register(14, 0xABCD, slave=1))
    tell("FC3", client.read_holding_registers(10, 5, slave=1), lambda r: r.registers == [*WORDS, 0xABCD])
    tell("FC4", client.read_input_registers(20, 10, slave=1), lambda r: r.registers == [3 * i + 7 for i in range(20, 30)])
    # These two take the unit under another name, and else are broadcasts.
    tell("FC22", client.mask_write_register(address=10, and_mask=0xFF00, or_mask=0x0055, unit=1))
    tell("FC22-value", client.read_holding_registers(10, 1, slave=1), lambda r: r.registers == [0x1255])
    tell("FC23", client.readwrite_registers(read_address=29, read_count=3, write_address=30, write_registers=WORDS, unit=1),
         lambda r: r.registers[1:] == WORDS[:2])
    tell("FC43", client.execute(ReadDeviceInformationRequest(read_code=1, object_id=0, unit=1)),
         lambda r: r.information[0] == b"Stepwright")
    tell("beyond", client.read_holding_registers(60000, 2, slave=1))
    tell("most", client.read_input_registers(0, 125, slave=1), lambda r: len(r.registers) == 125)
    client.close()
    print(json.dumps(found))


main()
