"""Files that are no such files at all: rubbish, other formats, folders, no end. A place, a code, exit 1, few lines."""

import pathlib
import random
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from cell_process import Demo, STEPWRIGHT, TIMEOUT_S, stepwright

CELL = pathlib.Path(__file__).parent
CONVEYOR = CELL.parent / "conveyor"
MOST_LINES = 120  # of diagnostics with their hints


def rubbish():
    """Bytes that were never meant to be read here, by name."""
    noise = random.Random(7)
    return {
        "nothing": b"",
        "noise": noise.randbytes(5000),
        "program": STEPWRIGHT.read_bytes()[:100_000],
        "zeros": b"\0" * 1000,
        "parentheses": b"(" * 200_000,
        "one_word": b"a" * 1_000_000,
        "json": b'{"a": [1, 2, 3]}\n',
        "brackets": b"[" * 50_000,
        "utf16": "(define (domain tank-bench))\n".encode("utf-16"),
    }


def takes_signals_itself(pid):
    """Whether a process has blocked SIGTERM, to read it when it likes."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    blocked = next(line for line in status.splitlines() if line.startswith("SigBlk:"))
    return int(blocked.split()[1], 16) >> (signal.SIGTERM - 1) & 1 == 1


class WrongFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("cell.toml", "binding.toml", "domain.pddl", "problem.pddl"):
            shutil.copy(CELL / name, self.folder)
        self.domain, self.problem = self.folder / "domain.pddl", self.folder / "problem.pddl"

    def refused(self, result, file, code):
        """Exit 1, the file with a code, and no more than somebody reads."""
        self.assertEqual(result.returncode, 1, f"{file}: {result.stderr[:2000]}")
        self.assertRegex(result.stderr, rf"(?m)^{file}(:\d+)*: {code}: ")
        self.assertLess(len(result.stderr.splitlines()), MOST_LINES)
        self.assertLess(max(map(len, result.stderr.splitlines())), 2000)
        self.assertEqual(result.stdout, "")

    def test_rubbish_as_pddl(self):
        for name, content in rubbish().items():
            file = self.folder / name
            file.write_bytes(content)
            self.refused(stepwright("plan", file, self.problem), file, r"P\d{4}")
            self.refused(stepwright("plan", self.domain, file), file, r"P\d{4}")

    def test_rubbish_as_a_plan(self):
        for name, content in rubbish().items():
            file = self.folder / name
            file.write_bytes(content)
            result = stepwright("validate", self.domain, self.problem, file, "--quiet")
            self.assertEqual(result.returncode, 1, name)
            self.assertRegex(result.stderr, rf"(?m)^{file}(:\d+)*: P\d{{4}}: ")
            self.assertLess(len(result.stderr.splitlines()), MOST_LINES)

    def test_rubbish_as_configuration(self):
        cell = self.folder / "cell.toml"
        binding = self.folder / "binding.toml"
        good = {cell: cell.read_bytes(), binding: binding.read_bytes()}
        for name, content in rubbish().items():
            for file, code in ((cell, r"C\d{4}"), (binding, r"B\d{4}")):
                if name == "nothing" and file == cell:
                    continue  # every key has a default
                file.write_bytes(content)
                for command in ("check", "demo") if file == cell and name == "noise" else ("check",):
                    options = ("--config", cell) if command == "check" else (cell, "--headless", "--fast")
                    result = stepwright(command, *options)
                    self.assertEqual(result.returncode, 1, (command, name))
                    text = result.stdout + result.stderr
                    self.assertRegex(text, rf"{file}(:\d+)*: (error )?{code}: ", (command, name))
                    self.assertLess(len(text.splitlines()), MOST_LINES, (command, name))
                file.write_bytes(good[file])

    def test_what_is_no_file(self):
        for path, reason in (("/nonexistent/d.pddl", "cannot be read"), (self.folder, "cannot be read"),
                             ("/dev/zero", "64 MB"), ("/dev/null", "the file ends")):
            for arguments in (("plan", path, self.problem), ("plan", self.domain, path),
                              ("validate", path, self.problem, self.problem)):
                result = stepwright(*arguments)
                self.refused(result, path, r"P\d{4}")
                self.assertIn(reason, result.stderr)
        for path in ("/nonexistent/cell.toml", self.folder / "none.toml"):
            self.refused(stepwright("demo", path, "--headless"), path, "M0012")

    def test_files_in_each_others_place(self):
        self.refused(stepwright("plan", self.problem, self.domain), self.problem, "P0003")
        self.refused(stepwright("plan", self.domain, self.domain), self.domain, "P0003")
        self.refused(stepwright("plan", self.folder / "binding.toml", self.problem), self.folder / "binding.toml", r"P\d{4}")
        other = stepwright("plan", self.domain, CONVEYOR / "problem.pddl")
        self.refused(other, CONVEYOR / "problem.pddl", "P0111")
        self.assertEqual(len(other.stderr.splitlines()), 2, other.stderr)

    def test_other_line_ends_and_marks_are_none(self):
        problem = self.problem.read_bytes()
        for content in (problem.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + problem,
                        problem.replace(b";", "; höher ".encode("latin-1"), 1)):
            self.problem.write_bytes(content)
            result = stepwright("plan", self.domain, self.problem, "--optimal")
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_an_interrupted_demo_says_so(self):
        with Demo("--set", "clock.speed=1") as demo:
            demo.wait_for_actions(1)
            demo.process.send_signal(signal.SIGINT)
            report, code = demo.result()
        self.assertEqual(code, 5)
        self.assertIn("interrupted", report["message"])
        self.assertNotIn("goal_reached", report)

    def test_an_interruption_before_the_first_plan(self):
        objects = " ".join(f"p{i}" for i in range(40))
        self.domain.write_text("(define (domain d) (:predicates (on ?a ?b) (in ?a)) (:action a :parameters (?a ?b ?c ?d ?e) "
                               ":precondition (and (in ?a) (in ?b) (in ?c) (in ?d) (in ?e)) :effect (on ?a ?b)))")
        facts = " ".join(f"(in p{i})" for i in range(40))
        self.problem.write_text(f"(define (problem p) (:domain d) (:objects {objects}) (:init {facts}) "
                                "(:goal (and (on p1 p2) (on p2 p1))))")
        command = [STEPWRIGHT, "plan", self.domain, self.problem, "--time", "100"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as planner:
            while not takes_signals_itself(planner.pid):
                self.assertIsNone(planner.poll())
                time.sleep(0.005)
            planner.send_signal(signal.SIGTERM)
            stdout, stderr = planner.communicate(timeout=TIMEOUT_S)
        self.assertEqual(planner.returncode, 4, stderr)
        self.assertIn("no plan was found: the search was interrupted", stderr)
        self.assertEqual(stdout, "")


if __name__ == "__main__":
    unittest.main()
