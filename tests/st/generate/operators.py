#!/usr/bin/env python3
"""Every operator and every overloaded standard function on every type that has it (7.3.2, 6.6.2.5)."""

from fractions import Fraction

from program import Program
from elementary import ALL, BITS, BOOL, INTEGERS, REALS, nearest

FOLDER = "7.3.2_operators/"


def quotient(a, b):
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


def remainder(a, b):
    return 0 if b == 0 else a - b * quotient(a, b)


def values_of(type_):
    edge = [type_.high, 1, 7, 2, type_.high // 3]
    return edge + ([-1, -7, type_.low] if type_.kind == "signed" else [0])


def arithmetic(type_):
    program = Program(f"{FOLDER}arithmetic_{type_.name.lower()}", f"+ - * / MOD and negation of {type_.name} wrap.",
                      "7.3.2-06 7.3.2-07")
    names = {value: program.variable(type_, type_.literal(value)) for value in values_of(type_)}
    for a, x in names.items():
        for b, y in names.items():
            program.check(type_, f"{x} + {y}", type_.wrap(a + b))
            program.check(type_, f"{x} - {y}", type_.wrap(a - b))
            program.check(type_, f"{x} * {y}", type_.wrap(a * b))
            if b != 0:
                program.check(type_, f"{x} / {y}", type_.wrap(quotient(a, b)))
            program.check(type_, f"{x} MOD {y}", type_.wrap(remainder(a, b)))
        if type_.kind == "signed":
            program.check(type_, f"-{x}", type_.wrap(-a))
            program.check(type_, f"ABS({x})", type_.wrap(abs(a)))
    program.write()


def constants(type_):
    """The same, folded by the compiler: constants mean what the machine does."""
    program = Program(f"{FOLDER}folded_{type_.name.lower()}", f"Constant expressions of {type_.name}.", "7.3.2-06")
    for a in values_of(type_):
        for b in (3, 1, type_.high):
            x, y = type_.literal(a), type_.literal(b)
            for operator, result in (("+", a + b), ("-", a - b), ("*", a * b), ("/", quotient(a, b)),
                                     ("MOD", remainder(a, b))):
                if type_.holds(result):
                    program.check(type_, f"{x} {operator} {y}", result)
    program.write()


def comparisons(type_):
    program = Program(f"{FOLDER}compare_{type_.name.lower()}", f"Comparisons of {type_.name}.", "7.3.2-12")
    values = [0, 1] if type_ is BOOL else [-1.5, 0.0, 2.25] if type_.kind == "real" else [type_.low, 1, type_.high]
    names = {value: program.variable(type_, type_.literal(value)) for value in values}
    for a, x in names.items():
        for b, y in names.items():
            for operator, result in (("=", a == b), ("<>", a != b), ("<", a < b), ("<=", a <= b), (">", a > b),
                                     (">=", a >= b)):
                program.check(BOOL, f"{x} {operator} {y}", BOOL.shown(result))
    program.write()


def selections(type_):
    program = Program(f"{FOLDER}select_{type_.name.lower()}", f"MAX, MIN, LIMIT, SEL, MUX and MOVE of {type_.name}.",
                      "6.6.2.5.8-02 6.6.2.5.8-03 6.6.2.5.8-04 6.6.2.5.8-05")
    values = [-1.5, 0.25, 8.0] if type_.kind == "real" else [type_.low, 5, type_.high]
    low, middle, high = (program.variable(type_, type_.literal(value)) for value in values)
    number = program.variable(INTEGERS[1], 2)
    for expression, result in ((f"MAX({middle}, {high}, {low})", 2), (f"MIN({middle}, {high}, {low})", 0),
                               (f"LIMIT({low}, {middle}, {high})", 1), (f"LIMIT({middle}, {low}, {high})", 1),
                               (f"LIMIT({low}, {high}, {middle})", 1), (f"SEL({number} = 2, {low}, {high})", 2),
                               (f"SEL({number} = 3, {low}, {high})", 0), (f"MUX({number}, {high}, {middle}, {low})", 0),
                               (f"MOVE({high})", 2)):
        program.check(type_, expression, type_.shown(values[result]))
    program.write()


def bitwise(type_):
    program = Program(f"{FOLDER}bits_{type_.name.lower()}", f"AND, OR, XOR, NOT, shifts and rotations of {type_.name}.",
                      "7.3.2-13 6.6.2.5.7-01 6.6.2.5.7-02 6.6.2.5.7-03 6.6.2.5.7-04")
    pattern = int("10010110" * (type_.bits // 8), 2)
    other = type_.high >> 3
    x = program.variable(type_, type_.literal(pattern))
    y = program.variable(type_, type_.literal(other))
    for operator, result in (("AND", pattern & other), ("OR", pattern | other), ("XOR", pattern ^ other)):
        program.check(type_, f"{x} {operator} {y}", result)
    program.check(type_, f"NOT {x}", type_.high - pattern)
    count = program.variable(INTEGERS[1])
    for n in (0, 1, type_.bits // 2 + 1, type_.bits - 1, type_.bits, type_.bits + 3):
        program.line(f"{count} := {n};")
        turn = n % type_.bits
        left = (pattern << turn | pattern >> (type_.bits - turn)) & type_.high
        right = (pattern >> turn | pattern << (type_.bits - turn)) & type_.high
        for function, result in (("SHL", pattern << n & type_.high), ("SHR", pattern >> n), ("ROL", left),
                                 ("ROR", right)):
            program.check(type_, f"{function}({x}, {count})", result)
            program.check(type_, f"{function}({x}, {n})", result)
    program.write()


def real_arithmetic(type_):
    program = Program(f"{FOLDER}arithmetic_{type_.name.lower()}", f"+ - * / of {type_.name} round to the nearest.",
                      "7.3.2-09")
    values = [nearest(each, type_) for each in (0.1, 3.0, -7.25, 1e10, 1.5e-5)]
    names = {value: program.variable(type_, type_.literal(value)) for value in values}
    for a, x in names.items():
        for b, y in names.items():
            left, right = Fraction(a), Fraction(b)
            for operator, exact in (("+", left + right), ("-", left - right), ("*", left * right), ("/", left / right)):
                program.check(type_, f"{x} {operator} {y}", type_.shown(nearest(exact, type_)))
    program.write()


def loops(type_):
    """FOR, CASE and indexes with a variable of the type."""
    program = Program(f"7.3.3_statements/loops_{type_.name.lower()}", f"FOR, CASE and an index of {type_.name}.",
                      "7.3.3.4-01 7.3.3.4-02 7.3.3.3-02 6.4.4.5-06")
    i = program.variable(type_)
    count, total, picked = (program.variable(INTEGERS[2]) for _ in range(3))
    table = f"v{len(program.variables) + 1}"
    program.variables.append(f"  {table} : ARRAY[0..4] OF DINT;")
    program.line(f"{count} := 0; {total} := 0;")
    program.line(f"FOR {i} := {type_.literal(type_.high - 2)} TO {type_.literal(type_.high)} DO {count} := {count} + 1; END_FOR;")
    program.line(f"(* CHECK {count} = 3 *)")
    program.line(f"FOR {i} := 4 TO 0 BY {'-1' if type_.kind == 'signed' else '1'} DO {total} := {total} + 1; END_FOR;")
    program.line(f"(* CHECK {total} = {5 if type_.kind == 'signed' else 0} *)")
    program.line(f"FOR {i} := 0 TO 4 DO {table}[{i}] := {total} + 10; END_FOR; (* CHECK {table}[4] = {15 if type_.kind == 'signed' else 10} *)")
    program.line(f"{i} := {type_.literal(type_.high)};")
    program.line(f"CASE {i} OF {type_.low}: {picked} := 1; {type_.high - 1}..{type_.high}: {picked} := 2; ELSE {picked} := 3; END_CASE; "
                 f"(* CHECK {picked} = 2 *)")
    program.write()


def main():
    for type_ in INTEGERS:
        arithmetic(type_)
        constants(type_)
        loops(type_)
    for type_ in ALL:
        comparisons(type_)
    for type_ in INTEGERS + BITS + REALS:
        selections(type_)
    for type_ in BITS:
        bitwise(type_)
    for type_ in REALS:
        real_arithmetic(type_)


if __name__ == "__main__":
    main()
