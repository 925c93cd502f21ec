"""Writes one generated language test, into tests/st/programs or below STEPWRIGHT_PROGRAMS."""

import os
import pathlib

ROOT = pathlib.Path(os.environ.get("STEPWRIGHT_PROGRAMS", pathlib.Path(__file__).resolve().parent.parent / "programs"))


class Program:
    def __init__(self, path, title, requirements):
        self.path = ROOT / (path + ".st")
        self.head = [f"(* {title} Generated: tests/st/generate. *)",
                     "(* REQ " + " ".join("REQ-61131-" + each for each in requirements.split()) + " *)"]
        self.variables = []
        self.body = []

    def variable(self, type_, initial=None):
        name = f"v{len(self.variables) + 1}"
        self.variables.append(f"  {name} : {type_.name}" + (f" := {initial}" if initial is not None else "") + ";")
        return name

    def check(self, type_, expression, expected):
        """A variable that the expression is assigned to, and its value."""
        name = self.variable(type_)
        self.body.append(f"  {name} := {expression}; (* CHECK {name} = {expected} *)")

    def line(self, text):
        self.body.append("  " + text)

    def write(self):
        self.path.parent.mkdir(parents=True, exist_ok=True)
        variables = ["VAR", *self.variables, "END_VAR"] if self.variables else []
        lines = [*self.head, "PROGRAM main", *variables, *self.body, "END_PROGRAM"]
        self.path.write_text("\n".join(lines) + "\n")
