"""The manual page: without a warning of its formatter, with every command, and installed with programs and units."""

import re
import shutil
import subprocess
import tempfile
import pathlib
import unittest

from processes import BIN, SOURCES

PAGE = SOURCES / "programs/man/stepwright.1"


def commands():
    """As programs/stepwright/main.cpp lists them."""
    source = (SOURCES / "programs/stepwright/main.cpp").read_text(encoding="utf-8")
    return re.findall(r'Command\{"([a-z0-9-]+)",', source)


class Manual(unittest.TestCase):
    @unittest.skipUnless(shutil.which("groff"), "no groff on this machine")
    def test_the_formatter_finds_nothing_wrong(self):
        done = subprocess.run(["groff", "-man", "-ww", "-Tutf8", PAGE], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("EXIT STATUS", re.sub(".\b", "", done.stdout))  # without bold and underlined

    @unittest.skipUnless(shutil.which("groff"), "no groff on this machine")
    def test_the_formatter_can_find_something(self):
        done = subprocess.run(["groff", "-man", "-ww", "-Tutf8"], input=".TH X 1\n.SH NAME\n.nosuchmacro\n",
                              capture_output=True, text=True, check=False)
        self.assertNotEqual(done.stderr, "")

    def test_every_command_has_its_entry(self):
        page = PAGE.read_text(encoding="utf-8")
        self.assertGreater(len(commands()), 10)
        for command in commands():
            self.assertRegex(page, rf"(?m)^\.TP\n\.BI?R? {command}(\\ .*|\s*)$")

    def test_every_entry_is_a_command(self):
        section = PAGE.read_text(encoding="utf-8").split(".SH COMMANDS", 1)[1].split(".SH SIGNALS", 1)[0]
        self.assertEqual(sorted(re.findall(r"(?m)^\.TP\n\.BI?R? ([a-z0-9-]+)", section)), sorted(commands()))

    def test_every_exit_code_is_told(self):
        codes = re.findall(r" = (\d),", (SOURCES / "runtime/ground/result/exit_code.h").read_text(encoding="utf-8"))
        page = PAGE.read_text(encoding="utf-8")
        for code in codes:
            self.assertIn(f"\n.TP\n.B {code}\n", page)

    def test_installing_brings_programs_page_and_units(self):
        with tempfile.TemporaryDirectory(prefix="stepwright-test-") as root:
            subprocess.run(["cmake", "--install", BIN.parent, "--prefix", root, "--component", "stepwright-base"],
                           check=True, capture_output=True)
            found = {path.relative_to(root).as_posix() for path in pathlib.Path(root).rglob("*") if path.is_file()}
            self.assertIn("share/man/man1/stepwright.1", found)
            self.assertIn("share/stepwright/cells/bench/cell.toml", found)
            self.assertIn("lib/systemd/system/stepwright@.service", found)
            for name in ("runtime", "guard", "link", "supervisor", "hmi", "modbus-server"):
                self.assertIn(f"lib/systemd/system/stepwright-{name}@.service", found)


if __name__ == "__main__":
    unittest.main()
