"""Completion in bash: it offers every command, and every option that a command's own help names."""

import os
import re
import subprocess
import unittest

from processes import BIN, PATIENCE_S, SOURCES, stepwright

COMPLETION = SOURCES / "programs/completion/stepwright.bash"


def commands():
    source = (SOURCES / "programs/stepwright/main.cpp").read_text(encoding="utf-8")
    return re.findall(r'Command\{"([a-z0-9-]+)",', source)


def completed(*words):
    """What bash offers for the last of the words."""
    script = 'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _stepwright stepwright; printf "%s\\n" "${COMPREPLY[@]}"'
    done = subprocess.run(["bash", "-c", script, COMPLETION, "stepwright", *words], capture_output=True, text=True,
                          timeout=PATIENCE_S, check=True, env={**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"})
    assert not done.stderr, done.stderr
    return sorted(filter(None, done.stdout.split("\n")))


def options_of(*words):
    """Those of its help, by another rule than that of the completion: every word of the section that begins with dashes."""
    text = stepwright(*words, "--help").stdout
    lines = [line for line in text.split("\n") if line.startswith("  -")]
    assert lines, text
    return sorted({each for line in lines for each in re.findall(r"--[a-z][a-z0-9-]*", line.split("  ")[1].split(" ")[0])})


class Completion(unittest.TestCase):
    def test_every_command(self):
        self.assertEqual(completed(""), sorted([*commands(), "--help", "--version"]))
        self.assertEqual(completed("mod"), ["modbus-client", "modbus-server"])

    def test_every_option_of_every_command(self):
        for command in commands():
            with self.subTest(command=command):
                options = options_of(command)
                self.assertIn("--help", options)
                self.assertEqual(completed(command, "--"), options)

    def test_commands_of_commands_have_options_of_their_own(self):
        found = completed("ltl", "")
        self.assertEqual(found, sorted(["automaton", "check", "monitor", "plan"]))
        for each in found:
            self.assertEqual(completed("ltl", each, "--"), options_of("ltl", each))

    def test_cells_of_demonstrations(self):
        self.assertEqual(completed("demo", ""), stepwright("demo", "--list").stdout.split())
        self.assertIn("bench", completed("demo", "be"))

    def test_elsewhere_files_which_bash_knows(self):
        self.assertEqual(completed("compile", "pl"), [])
        self.assertEqual(completed("runtime", "--config", "ce"), [])

    def test_no_such_command(self):
        self.assertEqual(completed("nosuch", "--"), [])


if __name__ == "__main__":
    unittest.main()
