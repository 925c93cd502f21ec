"""Malformed RTPS: frames made after the specification (OMG DDSI-RTPS 2.3, chapters 8.3, 9.4) and the descriptions of
what broke implementations (CVE-2024-30258, CVE-2024-30259, CVE-2025-62799, CVE-2025-64438), and mutations of real ones."""

import random
import socket
import struct

HEADER = b"RTPS\x02\x03\x01\x0f"  # protocol 2.3, vendor of Fast DDS
PREFIX = bytes(range(1, 13))
ACKNACK, HEARTBEAT, GAP, INFO_TS, INFO_SRC, INFO_REPLY_IP4, INFO_DST, INFO_REPLY = 6, 7, 8, 9, 12, 13, 14, 15
NACK_FRAG, HEARTBEAT_FRAG, DATA, DATA_FRAG = 0x12, 0x13, 0x15, 0x16
UNKNOWN = b"\0\0\0\0"
SPDP = (b"\x00\x01\x00\xc7", b"\x00\x01\x00\xc2")  # reader, writer: participants announce themselves
SEDP_WRITERS = (b"\x00\x00\x03\xc7", b"\x00\x00\x03\xc2")
SEDP_READERS = (b"\x00\x00\x04\xc7", b"\x00\x00\x04\xc2")
LIVELINESS = (b"\x00\x02\x00\xc7", b"\x00\x02\x00\xc2")
USER = (b"\x00\x00\x01\x07", b"\x00\x00\x01\x02")
PAIRS = (SPDP, SEDP_WRITERS, SEDP_READERS, LIVELINESS, USER, (UNKNOWN, UNKNOWN))
HUGE = (0, 1, 2**31 - 1, 2**31, 2**32 - 1)


def submessage(kind, body, flags=1, length=None):
    return struct.pack("<BBH", kind, flags, len(body) if length is None else length) + body


def frame(*parts, prefix=PREFIX):
    return HEADER + prefix + b"".join(parts)


def number(value):
    """A sequence number: high word signed, low word not."""
    return struct.pack("<iI", (value >> 32) & 0x7FFFFFFF if value >= 0 else -1, value & 0xFFFFFFFF)


def number_set(base, bits, words):
    return number(base) + struct.pack("<I", bits) + b"\xff\xff\xff\xff" * words


def parameter(kind, value, length=None):
    return struct.pack("<HH", kind, len(value) if length is None else length) + value


def data(pair, sequence, payload, flags=5, inline_at=16):
    return submessage(DATA, struct.pack("<HH", 0, inline_at) + pair[0] + pair[1] + number(sequence) + payload, flags)


def data_frag(pair, sequence, start, count, size, total, payload, inline_at=28):
    return submessage(DATA_FRAG, struct.pack("<HH", 0, inline_at) + pair[0] + pair[1] + number(sequence)
                      + struct.pack("<IHHI", start, count, size, total) + payload)


def gaps(prefix):
    for reader, writer in PAIRS:
        ids = reader + writer
        for size in range(0, 33, 4):  # a tiny GAP: its list cut, down to nothing
            yield frame(submessage(GAP, (ids + number(1) + number_set(2, 32, 1))[:size]), prefix=prefix)
        for start, base in ((1, 2**62), (2**62, 1), (0, 0), (-1, 2**40), (5, 4), (1, 2**63 - 1)):
            for bits in (0, 1, 256, 257, 2**32 - 1):
                for words in (0, 1, 8):
                    yield frame(submessage(GAP, ids + number(start) + number_set(base, bits, words)), prefix=prefix)


def acknowledgements(prefix):
    for reader, writer in PAIRS:
        ids = reader + writer
        for base in (0, 1, 2**62, -1):
            for bits in (0, 1, 255, 256, 257, 2**32 - 1):
                for words in (0, 1, 8, 9):
                    yield frame(submessage(ACKNACK, ids + number_set(base, bits, words) + b"\1\0\0\0"), prefix=prefix)
                yield frame(submessage(NACK_FRAG, ids + number(1) + struct.pack("<II", base & 0xFFFFFFFF, bits)),
                            prefix=prefix)
        for first, last in ((1, 2**62), (2**62, 1), (0, -1), (-5, -9), (2, 1), (1, 2**63 - 1)):
            for flags in (1, 3, 5, 7):
                yield frame(submessage(HEARTBEAT, ids + number(first) + number(last) + struct.pack("<i", -1), flags),
                            prefix=prefix)
        for last in HUGE:
            yield frame(submessage(HEARTBEAT_FRAG, ids + number(1) + struct.pack("<II", last, 1)), prefix=prefix)


def fragments(prefix):
    for pair in PAIRS:
        for start in (0, 1, 2, 2**32 - 1):
            for count in (0, 1, 2, 65535):
                for size in (0, 1, 64, 65535):
                    for total in (0, 1, 63, 2**31, 2**32 - 1):
                        yield frame(data_frag(pair, 1, start, count, size, total, b"\xaa" * 64), prefix=prefix)
        yield frame(data_frag(pair, 1, 1, 1, 64, 128, b"\xaa" * 64, inline_at=65535), prefix=prefix)
        # Pieces of one sample that do not agree about it.
        for total in (64, 4096, 1, 2**24):
            yield frame(data_frag(pair, 7, 1, 1, 64, total, b"\xaa" * 64),
                        data_frag(pair, 7, 2, 1, 32, 128, b"\xbb" * 64), prefix=prefix)


def lists(prefix):
    """Parameter lists of discovery that lie about themselves."""
    start = b"\0\3\0\0"  # PL_CDR_LE
    sentinel = parameter(1, b"")
    guid = parameter(0x50, prefix + b"\x00\x00\x01\xc1")
    good = start + parameter(0x15, b"\2\3\0\0") + parameter(0x16, b"\1\x0f\0\0") + guid
    texts = [parameter(0x05, struct.pack("<I", size) + b"topic\0\0\0") for size in (*HUGE, 5, 6, 9)]
    locators = [parameter(0x31, struct.pack("<iI", kind, port) + b"\xff" * 16)
                for kind in (-1, 0, 1, 2, 4, 2**31 - 1) for port in (0, 7411, 2**32 - 1)]
    properties = [parameter(0x59, struct.pack("<I", count) + struct.pack("<I", 2**31) + b"x" * 8) for count in HUGE]
    leases = [parameter(0x02, struct.pack("<iI", seconds, 2**32 - 1)) for seconds in (0, -1, 2**31 - 1)]
    keys = [parameter(0x70, b""), parameter(0x71, b"\xff" * 4), parameter(0x5A, b"\0" * 3), parameter(0x29, b"\xff" * 4),
            parameter(0x1D, struct.pack("<I", 2**31)), parameter(0x2C, struct.pack("<I", 2**32 - 1) + b"\1" * 12),
            parameter(0x72, struct.pack("<I", 2**32 - 1)), parameter(0x75, struct.pack("<I", 2**30) + b"\1" * 12),
            parameter(0x8007, b"\xff" * 16), parameter(0x7FFF, b"\xff" * 32), parameter(0x3FFF, b"")]
    sequence = 1
    for pair in (SPDP, SEDP_WRITERS, SEDP_READERS, LIVELINESS):
        for each in (*texts, *locators, *properties, *leases, *keys):
            for tail in (sentinel, b"", b"\1", parameter(0x05, b"", 65535)):
                sequence += 1
                yield frame(data(pair, sequence, good + each + tail), prefix=prefix)
        for length in (1, 2, 3, 5, 65535, 65532):
            sequence += 1
            yield frame(data(pair, sequence, good + parameter(0x50, b"\1" * 16, length)), prefix=prefix)
        for cut in range(0, len(good), 2):
            sequence += 1
            yield frame(data(pair, sequence, good[:cut]), prefix=prefix)
        for inline_at in (0, 1, 15, 17, 64, 65535):
            yield frame(data(pair, sequence, good + sentinel, flags=7, inline_at=inline_at), prefix=prefix)
        for flags in range(0, 32):
            yield frame(data(pair, 2**62, good + sentinel, flags=flags), prefix=prefix)


def shapes(prefix):
    """What is wrong with the message around its parts."""
    whole = frame(submessage(INFO_TS, b"\0" * 8), data(SPDP, 1, b"\0\3\0\0" + parameter(1, b"")), prefix=prefix)
    for size in range(len(whole)):
        yield whole[:size]
    for kind in range(256):
        yield frame(submessage(kind, b""), prefix=prefix)
        yield frame(submessage(kind, b"", length=65535), prefix=prefix)
        yield frame(submessage(kind, b"\xff" * 16, flags=255), submessage(kind, b""), prefix=prefix)
        yield frame(submessage(kind, b"\0" * 3), prefix=prefix)
    for count in HUGE:
        yield frame(submessage(INFO_REPLY, struct.pack("<I", count) + b"\1" * 24, flags=3), prefix=prefix)
        yield frame(submessage(INFO_REPLY_IP4, struct.pack("<I", count), flags=3), prefix=prefix)
    yield frame(*[submessage(INFO_DST, bytes(12))] * 4000, prefix=prefix)
    yield frame(*[submessage(GAP, b"")] * 10000, prefix=prefix)
    for head in (b"RTPS", b"RTPX\x02\x03\x01\x0f" + PREFIX, b"RTPS\xff\xff\x01\x0f" + PREFIX, b"", b"\0" * 65000):
        yield head


def corpus(prefixes):
    """Every frame made by hand, from each of the senders (guid prefixes of real participants, and one of nobody)."""
    for prefix in prefixes:
        for family in (shapes, gaps, acknowledgements, fragments, lists):
            yield from family(prefix)


def mutated(packets, count, seed):
    """Real packets with something changed: bits, lengths, the end, or one spliced to another."""
    chance = random.Random(seed)
    for _ in range(count):
        packet = bytearray(chance.choice(packets))
        for _ in range(chance.randint(1, 4)):
            kind = chance.randrange(5)
            at = chance.randrange(20, len(packet)) if len(packet) > 20 else 0
            if kind == 0:
                packet[at] ^= 1 << chance.randrange(8)
            elif kind == 1:
                packet[at:at + 4] = struct.pack("<I", chance.choice(HUGE))
            elif kind == 2:
                packet = packet[:at]
            elif kind == 3:
                packet += chance.choice(packets)[20:]
            else:
                packet[at:at] = bytes(chance.randrange(256) for _ in range(chance.randrange(16)))
            if len(packet) < 21:
                break
        yield bytes(packet[:65000])


def ports(domain, participants=4):
    """Discovery and user ports of the first participants of a domain (RTPS 2.3, 9.6.1.1)."""
    base = 7400 + 250 * domain
    return [base + 10 + offset + 2 * each for each in range(participants) for offset in (0, 1)]


def capture(count, seconds):
    """Real RTPS packets from the loopback interface of this network namespace."""
    raw = socket.socket(socket.AF_PACKET, socket.SOCK_DGRAM, socket.htons(0x0800))
    raw.bind(("lo", 0))
    raw.settimeout(seconds)
    packets = []
    try:
        while len(packets) < count:
            packet = raw.recv(65535)
            payload = packet[(packet[0] & 15) * 4 + 8:]
            if packet[9] == 17 and payload[:4] == b"RTPS":
                packets.append(payload)
    except TimeoutError:
        pass
    finally:
        raw.close()
    return packets
