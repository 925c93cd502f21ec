"""Real processes of a cell for tests in Python: started, watched through their output and figures, always ended."""

import http.client
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time

BIN = pathlib.Path(os.environ["STEPWRIGHT_BIN_DIR"])
TESTS = pathlib.Path(os.environ.get("STEPWRIGHT_TEST_DIR", BIN.parent / "tests"))
SOURCES = pathlib.Path(os.environ.get("STEPWRIGHT_SOURCE_DIR", pathlib.Path(__file__).parents[3]))
STEPWRIGHT = BIN / "stepwright"
PATIENCE_S = 600
NO_PLANT = '[plant]\nkind = "none"\n'


def stepwright(*arguments, **options):
    """Runs a command to its end; output as text."""
    return subprocess.run([STEPWRIGHT, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE_S,
                          check=False, **options)


def eventually(condition, patience_s=PATIENCE_S, pause_s=0.01):
    """Waits for a condition that another process brings about; what it came to at the end."""
    deadline = time.monotonic() + patience_s
    while time.monotonic() < deadline:
        found = condition()
        if found:
            return found
        time.sleep(pause_s)
    return condition()


class Process:
    """A program in the background; its output in a file."""

    def __init__(self, arguments, log, **options):
        self.log = pathlib.Path(log)
        self.file = open(self.log, "ab")
        self.process = subprocess.Popen([str(each) for each in arguments], stdout=self.file, stderr=subprocess.STDOUT,
                                        **options)

    @property
    def pid(self):
        return self.process.pid

    def output(self):
        return self.log.read_text(encoding="utf-8", errors="replace")

    def wait_for(self, pattern, patience_s=PATIENCE_S):
        """Waits until the output matches; raises if the process ends before."""
        def look():
            match = re.search(pattern, self.output())
            if match is None and self.process.poll() is not None and not re.search(pattern, self.output()):
                raise AssertionError(f"it ended with {self.process.returncode} before it said '{pattern}':\n{self.output()}")
            return match
        match = eventually(look, patience_s)
        assert match, f"it never said '{pattern}':\n{self.output()}"
        return match

    def send(self, number):
        self.process.send_signal(number)

    def wait(self, patience_s=PATIENCE_S):
        return self.process.wait(timeout=patience_s)

    def running(self):
        return self.process.poll() is None

    def end(self, number=signal.SIGTERM):
        if self.running():
            self.send(number)
            try:
                self.wait(PATIENCE_S)
            except subprocess.TimeoutExpired:
                self.process.kill()
        code = self.process.wait()
        if self.process.stdin:
            self.process.stdin.close()
        if not self.file.closed:
            self.file.close()
        return code


class Cell:
    """A folder with a configuration, and the processes that run on it."""

    def __init__(self, more=NO_PLANT, name=None, domain=90, dds="", prefix=()):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        self.name = name or f"test-{os.getpid()}"
        self.domain = domain
        self.dds = dds
        self.prefix = list(prefix)
        self.config = self.folder / "cell.toml"
        self.state = self.folder / "state"
        self.processes = []
        self.started = 0
        self.write(more)

    def write(self, more):
        self.config.write_text(f'[cell]\nname = "{self.name}"\nstate_dir = "state"\n'
                               f"[dds]\ndomain_id = {self.domain}\n{self.dds}{more}", encoding="utf-8")

    @property
    def socket(self):
        return self.state / "runtime.sock"

    def served(self):
        """Whether somebody takes connections at the socket: it is there a moment before."""
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as client:
            return client.connect_ex(str(self.socket)) == 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.end()
        shutil.rmtree(self.folder, ignore_errors=True)

    def start(self, command, *arguments, **options):
        self.started += 1
        log = self.folder / f"{command}{self.started}.log"
        process = Process([*self.prefix, STEPWRIGHT, command, "--config", self.config, *arguments], log, **options)
        self.processes.append(process)
        return process

    def start_runtime(self, **options):
        runtime = self.start("runtime", **options)
        runtime.wait_for("listens on")
        return runtime

    def load(self, interval_us, *more):
        """Downloads and starts a program; its digest."""
        done = subprocess.run([TESTS / "cells_load", self.socket, str(interval_us), *more], capture_output=True,
                              text=True, timeout=PATIENCE_S, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    def metrics(self):
        """The figures of the runtime by name and labels; raises if it does not answer."""
        done = stepwright("metrics", "--config", self.config)
        assert done.returncode == 0, done.stdout + done.stderr
        return parse_metrics(done.stdout)

    def figure(self, name):
        return self.metrics()[(name, (("runtime", self.name),))]


def get(port, path="/metrics", host=None, address="127.0.0.1"):
    """A real HTTP request: the answer and its text."""
    connection = http.client.HTTPConnection(address, port, timeout=PATIENCE_S)
    connection.request("GET", path, headers={"Host": host or f"{address}:{port}"})
    answer = connection.getresponse()
    text = answer.read().decode()
    connection.close()
    return answer, text


def figures_of(process, address="127.0.0.1"):
    """Where a process says that it serves its figures: a function that fetches them, by name and labels."""
    port = int(process.wait_for(r"figures at http://[\d.]+:(\d+)/metrics").group(1))

    def fetch():
        answer, text = get(port, address=address)
        assert answer.status == 200, answer.status
        assert answer.headers["Content-Type"] == "text/plain; version=0.0.4; charset=utf-8"
        return parse_metrics(text)

    fetch.port = port
    return fetch


METRIC_LINE = re.compile(r'([a-zA-Z_:][a-zA-Z0-9_:]*)(?:\{(.*)\})? (\S+)$')
LABEL = re.compile(r'([a-zA-Z_][a-zA-Z0-9_]*)="((?:[^"\\\n]|\\["\\n])*)"(?:,|$)')


def parse_metrics(text):
    """A strict reader of the text exposition format 0.0.4: {(name, ((label, value), ...)): number}. Raises ValueError
    where a scraper might: a sample without TYPE, a family in two places, a label twice, no newline at the end."""
    if not text.endswith("\n"):
        raise ValueError("the last line is not ended")
    samples, types, helps, family, seen = {}, {}, set(), None, set()
    for line in text[:-1].split("\n"):
        if line.startswith("# HELP "):
            name = line.split(" ", 3)[2]
            if name in helps or len(line.split(" ", 3)) < 4:
                raise ValueError(f"HELP twice or empty: {line}")
            helps.add(name)
            continue
        if line.startswith("# TYPE "):
            _, _, name, kind = line.split(" ")
            if kind not in ("counter", "gauge", "summary", "histogram", "untyped") or name in types:
                raise ValueError(f"wrong TYPE: {line}")
            types[name] = kind
            family = name
            if name in seen:
                raise ValueError(f"TYPE after samples: {line}")
            continue
        match = METRIC_LINE.match(line)
        if not match:
            raise ValueError(f"no sample: {line!r}")
        name, labels, value = match.groups()
        if name != family or name not in helps:
            raise ValueError(f"outside its family: {line}")
        seen.add(name)
        found, position = [], 0
        while labels and position < len(labels):
            label = LABEL.match(labels, position)
            if not label:
                raise ValueError(f"wrong labels: {line}")
            found.append((label.group(1), label.group(2)))
            position = label.end()
        if len({each for each, _ in found}) != len(found):
            raise ValueError(f"a label twice: {line}")
        if types[name] != "summary" and any(each == "quantile" for each, _ in found):
            raise ValueError(f"a quantile of no summary: {line}")
        if types[name] == "counter" and (not name.endswith("_total") or float(value) < 0):
            raise ValueError(f"a counter that is none: {line}")
        if (name, tuple(found)) in samples:
            raise ValueError(f"twice: {line}")
        samples[(name, tuple(found))] = float(value)
    return samples
