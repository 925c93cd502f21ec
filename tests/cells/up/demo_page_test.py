"""`stepwright demo` with a page: it says the address once the page is there, and never one of a page that then fails."""

import pathlib
import re
import signal
import socket
import tempfile
import unittest

from processes import SOURCES, STEPWRIGHT, Process, get

BENCH = SOURCES / "tests/cells/bench"


class DemoPage(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def demo(self, cell, *arguments):
        process = Process([STEPWRIGHT, "demo", cell, *arguments], self.folder / "demo.log")
        self.addCleanup(process.end)
        return process

    def refused(self, *arguments):
        process = self.demo(*arguments)
        self.assertEqual(process.wait(), 1, process.output())
        self.assertNotIn("http://", process.output())
        return process.output()

    def test_the_address_is_that_of_a_page_that_is_there(self):
        process = self.demo("bench", "--port", "0")
        port = int(process.wait_for(r"Open http://127\.0\.0\.1:(\d+)/ in a browser").group(1))
        self.assertEqual(get(port, "/")[0].status, 200)
        process.wait_for(r"set-up token [A-Z2-9-]{24} \(once\)")
        process.send(signal.SIGINT)
        self.assertEqual(process.wait(), 0, process.output())

    def test_a_cell_without_a_planner_is_refused_with_the_command_that_runs_it(self):
        cell = self.folder / "cell.toml"
        cell.write_text('[cell]\nname = "line"\n[plant]\nkind = "none"\n', encoding="utf-8")
        said = self.refused(cell)
        self.assertIn("cell.toml: M0011: this cell has no planner", said)
        self.assertRegex(said, r"stepwright up .*cell\.toml runs its processes")

    def test_a_port_in_use_has_no_address(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            said = self.refused("bench", "--port", str(port))
        self.assertIn(f"H0001: port {port} of 127.0.0.1 is in use", said)

    def test_a_planning_file_that_is_wrong_has_no_address(self):
        wrong = self.folder / "problem.pddl"
        text = (BENCH / "problem.pddl").read_text(encoding="utf-8")
        wrong.write_text(re.sub(r"\(:goal", "(:gaol", text), encoding="utf-8")
        said = self.refused("bench", "--port", "0", "--set", f'planning.problem="{wrong}"')
        self.assertRegex(said, r"problem\.pddl:\d+")


if __name__ == "__main__":
    unittest.main()
