"""A Modbus TCP client of a few lines, for tests that send what no library would."""

import socket
import struct


def frame(pdu, transaction=1, unit=1):
    return struct.pack(">HHHB", transaction, 0, len(pdu) + 1, unit) + pdu


def read_request(first, count, function=3):
    return struct.pack(">BHH", function, first, count)


def write_request(first, *values):
    return struct.pack(f">BHHB{len(values)}H", 16, first, len(values), 2 * len(values), *values)


class Refused(Exception):
    """An exception response; args[0] is its code."""


class Client:
    def __init__(self, port, host="127.0.0.1", source=None, timeout=600):
        self.socket = socket.create_connection((host, port), timeout=timeout,
                                               source_address=(source, 0) if source else None)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.transaction = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.socket.close()

    def send(self, pdu):
        self.transaction = self.transaction % 65535 + 1
        self.socket.sendall(frame(pdu, self.transaction))
        return self.transaction

    def exactly(self, count):
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise EOFError("the server closed the connection")
            data += part
        return data

    def answer(self, transaction):
        """The PDU of the next answer."""
        found, protocol, length, _ = struct.unpack(">HHHB", self.exactly(7))
        assert (found, protocol) == (transaction, 0), (found, transaction, protocol)
        pdu = self.exactly(length - 1)
        if pdu[0] & 0x80:
            raise Refused(pdu[1])
        return pdu

    def ask(self, pdu):
        return self.answer(self.send(pdu))

    def read(self, first, count=1, function=3):
        pdu = self.ask(read_request(first, count, function))
        return list(struct.unpack(f">{count}H", pdu[2:]))

    def read_bits(self, first, count=1, function=1):
        pdu = self.ask(read_request(first, count, function))
        return [pdu[2 + i // 8] >> i % 8 & 1 for i in range(count)]

    def write(self, first, *values):
        self.ask(write_request(first, *values))
