"""Controllers of the tests: the firmware as a process, on a pseudo terminal or over TCP."""

import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

from cell_process import BIN, Demo

PROGRAM = BIN / "firmware_host"
PATIENCE_S = 600


class Controller:
    """A process that is a controller; `where` is what `demo --controller` takes."""

    def __init__(self, tcp=False):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        line = ["--tcp", "0"] if tcp else ["--link", self.folder / "line"]
        self.process = subprocess.Popen([PROGRAM, *line, self.folder / "flash"], stdout=subprocess.PIPE, text=True)
        self.where = self.process.stdout.readline().strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.speak()
        self.process.terminate()
        self.process.wait(timeout=PATIENCE_S)
        self.process.stdout.close()
        shutil.rmtree(self.folder)

    def silence(self):
        """It does not answer any more, until `speak`."""
        self.process.send_signal(signal.SIGSTOP)

    def speak(self):
        self.process.send_signal(signal.SIGCONT)

    def lose_power(self):
        """And it comes back at once: nothing but its flash is left."""
        self.process.send_signal(signal.SIGUSR1)


def run_bench(*arguments):
    """A controller of which the machine takes the processor for seconds is not lost by it."""
    patient = ("--set", "controller.lost_after_ms=60000") if "--controller" in arguments else ()
    with Demo("--fast", "--no-compare", *patient, *arguments) as demo:
        return demo.result()


def eventually(condition):
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        if condition():
            return True
        time.sleep(0.01)
    return False


def log_of(demo, program):
    log = demo.state / f"{program}.log"
    return log.read_text(encoding="utf-8") if log.exists() else ""

