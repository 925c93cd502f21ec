#!/usr/bin/env python3
"""Explicit and implicit conversions of every pair of elementary types (6.6.1.6, 6.6.2.5.3, tables 22 to 27)."""

import struct

from program import Program
from elementary import ALL, BOOL, INTEGERS, REALS, nearest, rounded, widens

FOLDER = "6.6.1.6_conversions/"


def samples(source):
    if source is BOOL:
        return [0, 1]
    if source.kind == "real":
        return [nearest(each, source) for each in (0.0, 0.5, 1.5, 2.5, 3.4999, 100.25, -0.5, -1.5, -2.5, -100.75)]
    values = [0, 1, source.high, source.high // 2 + 1, 100]
    return values + ([-1, source.low, -100] if source.kind == "signed" else [])


def converted(value, source, target):
    """The value, or None where the standard does not say or the pair has a test of its own."""
    if target is BOOL:
        return value & 1 if source.kind == "bits" else int(value != 0) if value in (0, 1) else None
    if {source.kind, target.kind} == {"real", "bits"}:
        return transferred(value, source, target)
    if source.kind == "real":
        if target.kind == "real":
            return nearest(value, target)
        result = rounded(value)
        return result if target.holds(result) else None
    if target.kind == "real":
        return nearest(value, target)
    if target.kind == "bits" and source.bits < target.bits and value < 0:
        return None
    return target.wrap(value)


def transferred(value, source, target):
    """Table 26: the bits of a real, only where both have as many."""
    if source.bits != target.bits:
        return None
    real, bits = (("<f", "<I") if source.bits == 32 else ("<d", "<Q"))
    if source.kind == "real":
        return struct.unpack(bits, struct.pack(real, value))[0]
    result = struct.unpack(real, struct.pack(bits, value))[0]
    return result if 1e-30 < abs(result) < 1e30 else None


def explicit(source, target):
    program = Program(f"{FOLDER}{source.name.lower()}_to_{target.name.lower()}",
                      f"{source.name}_TO_{target.name}.", "6.6.2.5.3-01")
    for value in samples(source):
        result = converted(value, source, target)
        if result is None:
            continue
        name = program.variable(source, source.literal(value))
        program.check(target, f"{source.name}_TO_{target.name}({name})", target.shown(result))
    if program.body:
        program.write()


def overflow(source, target):
    """A real just outside of the integer's range traps, just inside it does not."""
    program = Program(f"{FOLDER}{source.name.lower()}_to_{target.name.lower()}_range",
                      f"{source.name}_TO_{target.name} traps outside of the range of {target.name}.", "6.6.2.5.3-04")
    x, y = program.variable(source), program.variable(target)
    program.line(f"{y} := {source.name}_TO_{target.name}({x});")
    line = len(program.head) + 1 + len(program.variables) + 3
    scan = 0
    for value in (float(target.high) * 2, float(target.low) * 2 - 1, 1e30):
        scan += 1
        program.line(f"(* SET scan {scan}: {x} = {value!r} *) "
                     f"(* CHECK trap scan {scan}: conversion out of range at {line} *)")
    program.write()


def implicit(source):
    """Every type that takes the values of another does so without being asked; the others refuse."""
    allowed = Program(f"{FOLDER}implicit_{source.name.lower()}", f"{source.name} goes into every type that holds it.",
                      "6.6.1.6-01")
    refused = Program(f"{FOLDER}refused_{source.name.lower()}", f"{source.name} goes into no type that does not hold it.",
                      "6.6.1.6-02")
    largest = 1 if source is BOOL else 1.5 if source.kind == "real" else source.high
    value = allowed.variable(source, source.literal(largest))
    other = refused.variable(source)
    for target in ALL:
        if target is not source and widens(source, target):
            expected = nearest(largest, target) if target.kind == "real" else largest
            allowed.check(target, value, target.shown(expected))
        elif target is not source:
            refused.line(f"{refused.variable(target)} := {other}; (* ERROR E0301 *)")
    if allowed.body:
        allowed.write()
    refused.write()


def main():
    for source in ALL:
        implicit(source)
        for target in ALL:
            if source is not target:
                explicit(source, target)
    for source in REALS:
        for target in INTEGERS:
            overflow(source, target)


if __name__ == "__main__":
    main()
