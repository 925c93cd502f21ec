"""Starts the demo of a cell as a user would, finds its processes, and reads what it leaves."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time

BIN = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"])
STEPWRIGHT = BIN / "stepwright"
TIMEOUT_S = 900  # of what never ends; no measure of a machine
TIME_TO_PROVE = ("--set", "planning.time_ms=600_000")  # the proof takes as long as the machine takes


def stepwright(*arguments, **options):
    """Runs a command to its end; stdout and stderr as text."""
    return subprocess.run([STEPWRIGHT, *map(str, arguments)], capture_output=True, text=True, timeout=TIMEOUT_S,
                          check=False, **options)


class Demo:
    """`stepwright demo CELL --headless` in the background."""

    def __init__(self, *arguments, cell="bench"):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        self.state = self.folder / "state"
        self.json = self.folder / "report.json"
        self.process = subprocess.Popen(
            [STEPWRIGHT, "demo", cell, "--headless", "--json", self.json, "--state-dir", self.state,
             *map(str, arguments)],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
        self.process.communicate(timeout=TIMEOUT_S)
        shutil.rmtree(self.folder)

    def pid_of(self, program):
        """The process of `stepwright-<program>` among the demo's children, or None."""
        return self.child(f"stepwright-{program}")

    def child(self, executable):
        """The process of an executable among the demo's children, or None."""
        own = pathlib.Path(f"/proc/{self.process.pid}")
        try:
            children = (own / f"task/{self.process.pid}/children").read_text(encoding="ascii")
        except OSError:  # the demo has ended
            return None
        for child in children.split():
            try:
                command = pathlib.Path(f"/proc/{child}/cmdline").read_bytes().split(b"\0")
            except OSError:  # it ended since the list was read
                continue
            if command[0].endswith(executable.encode()):
                return int(child)
        return None

    def wait_for_line(self, program, pattern):
        """Waits until a program's log matches `pattern`."""
        self.time_of_line(program, pattern)

    def log_bytes(self, program):
        """How much a program has written so far."""
        log = self.state / f"{program}.log"
        return log.stat().st_size if log.exists() else 0

    def time_of_line(self, program, pattern, behind=0):
        """Waits until what a program's log holds behind that many bytes matches `pattern`. Returns when the program
        wrote last, as the system noted it: this test may look late without measuring more."""
        log = self.state / f"{program}.log"
        deadline = time.monotonic() + TIMEOUT_S
        while time.monotonic() < deadline:
            if log.exists() and re.search(pattern, log.read_bytes()[behind:].decode()):
                return log.stat().st_mtime
            if self.process.poll() is not None:
                raise AssertionError(f"the demo ended before {program} said '{pattern}':\n{self.output()}")
            time.sleep(0.005)
        raise AssertionError(f"{program} never said '{pattern}'")

    def wait_for_actions(self, count):
        """Waits until the journal has at least `count` completed actions."""
        journal = self.state / "executive.json"
        deadline = time.monotonic() + TIMEOUT_S
        while time.monotonic() < deadline:
            if journal.exists():
                record = json.loads(journal.read_text(encoding="utf-8"))["record"]
                done = sum(a["state"] == "done" for e in record["episodes"] for a in e["actions"])
                if done >= count:
                    return
            if self.process.poll() is not None:
                raise AssertionError(f"the demo ended early:\n{self.output()}")
            time.sleep(0.005)
        raise AssertionError(f"fewer than {count} actions were done")

    def kill_foreign(self, executable):
        """SIGKILL for a child that is none of ours."""
        os.kill(self.child(executable), signal.SIGKILL)

    def hold_up_foreign(self, executable, seconds):
        """A child that is none of ours gets no time of the machine for so long."""
        pid = self.child(executable)
        os.kill(pid, signal.SIGSTOP)
        time.sleep(seconds)
        os.kill(pid, signal.SIGCONT)

    def kill(self, program, number=signal.SIGKILL):
        pid = self.pid_of(program)
        assert pid is not None, f"{program} does not run"
        os.kill(pid, number)
        return pid

    def output(self):
        logs = "".join(f"--- {log.name}\n{log.read_text(encoding='utf-8')}" for log in sorted(self.state.glob("*.log")))
        return (self.process.stdout.read() if self.process.stdout else "") + logs

    def result(self):
        """Waits for the end; the report and the exit code."""
        text, _ = self.process.communicate(timeout=TIMEOUT_S)
        assert self.json.exists(), f"no report:\n{text}"
        report = json.loads(self.json.read_text(encoding="utf-8"))
        report["stdout"] = text
        return report, self.process.returncode
