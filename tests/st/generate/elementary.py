"""The elementary types that the generated language tests are about, with exact arithmetic on their values."""

import struct
from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Type:
    name: str
    kind: str  # bool, signed, unsigned, bits, real
    bits: int

    @property
    def low(self):
        return -(1 << (self.bits - 1)) if self.kind == "signed" else 0

    @property
    def high(self):
        return (1 << (self.bits - 1)) - 1 if self.kind == "signed" else (1 << self.bits) - 1

    def wrap(self, value):
        value &= (1 << self.bits) - 1
        return value - (1 << self.bits) if value > self.high else value

    def holds(self, value):
        return self.low <= value <= self.high

    def literal(self, value):
        """As it is written in a program, with its type."""
        if self.kind == "bool":
            return "TRUE" if value else "FALSE"
        if self.kind == "real":
            return f"{self.name}#{number(value)}"
        return f"{self.name}#{value}"

    def shown(self, value):
        """As CHECK writes it."""
        if self.kind == "bool":
            return "TRUE" if value else "FALSE"
        return number(value) if self.kind == "real" else str(value)


BOOL = Type("BOOL", "bool", 1)
SIGNED = [Type("SINT", "signed", 8), Type("INT", "signed", 16), Type("DINT", "signed", 32), Type("LINT", "signed", 64)]
UNSIGNED = [Type("USINT", "unsigned", 8), Type("UINT", "unsigned", 16), Type("UDINT", "unsigned", 32),
            Type("ULINT", "unsigned", 64)]
BITS = [Type("BYTE", "bits", 8), Type("WORD", "bits", 16), Type("DWORD", "bits", 32), Type("LWORD", "bits", 64)]
REAL = Type("REAL", "real", 32)
LREAL = Type("LREAL", "real", 64)
INTEGERS = SIGNED + UNSIGNED
REALS = [REAL, LREAL]
ALL = [BOOL] + INTEGERS + BITS + REALS


def single(value):
    """The REAL nearest to a number, ties to even, as a float."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def nearest(value, type_):
    """The value of a real type nearest to an exact one. Through double only where that rounds once."""
    exact = Fraction(value)
    double = float(exact)
    if type_ is LREAL:
        return double
    candidates = {single(double)}
    bits = struct.unpack("<i", struct.pack("<f", single(double)))[0]
    for step in (-1, 1):
        if bits != 0:
            candidates.add(struct.unpack("<f", struct.pack("<i", bits + step))[0])
    def distance(each):
        last = struct.unpack("<i", struct.pack("<f", each))[0] & 1
        return (abs(Fraction(each) - exact), last)
    return min(candidates, key=distance)


def number(value):
    """A decimal number with a point that reads back to the same value."""
    return repr(float(value)) if not float(value).is_integer() or abs(value) >= 1e16 else f"{int(value)}.0"


def rounded(value):
    """To the nearest integer, ties to even."""
    return round(Fraction(value))


def widens(source, target):
    """Figure 12: implicit conversions that keep every value."""
    if source is target:
        return True
    if source.kind == "bool":
        return target.kind == "bits"
    if source.kind == "bits":
        return target.kind == "bits" and source.bits < target.bits
    if source.kind == "real":
        return target.kind == "real" and source.bits < target.bits
    if target.kind in ("signed", "unsigned"):
        return target.low <= source.low and source.high <= target.high
    if target.kind == "real":
        return source.bits <= (16 if target is REAL else 32)
    return False
