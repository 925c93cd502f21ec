"""A cell of this folder, copied, with its runtime; scans are run one after the other as a test asks for them."""

import json
import os
import pathlib
import re
import shutil
import subprocess

from processes import Cell, Process, STEPWRIGHT, eventually, stepwright

HERE = pathlib.Path(__file__).parent


class SteppedCell(Cell):
    """`file` of this folder with changes (text, other text) to it. `limits`: its [plant] says how long a process may take."""

    def __init__(self, file, *changes, limits=True):
        super().__init__()
        shutil.copytree(HERE, self.folder, dirs_exist_ok=True)
        text = (HERE / file).read_text(encoding="utf-8")
        for old, new in (("speed = 1.0", "speed = 0"), ("speed = 10.0", "speed = 0"),
                         ('\n[clock]', '\nstate_dir = "state"\n[clock]'), *changes):
            assert old in text or old.startswith("speed"), old
            text = text.replace(old, new, 1)
        text += "\n[plant]\n" if "[plant]" not in text else ""
        text = text.replace("[plant]\n", "[plant]\n" + "".join(
            f"{key} = {value}\n" for key, value in (("timeout_ms", 60_000), ("start_timeout_ms", 120_000))
            if limits and key not in text), 1)
        self.config.write_text(text, encoding="utf-8")

    def check(self):
        """What `check` says: (exit code, diagnostics)."""
        report = self.folder / "check.json"
        done = stepwright("check", self.config, "--json", report)
        assert report.exists(), done.stderr
        return done.returncode, json.loads(report.read_text(encoding="utf-8"))["diagnostics"]

    def refused(self):
        """What a runtime says that does not start."""
        log = self.folder / "refused.log"
        process = Process([STEPWRIGHT, "runtime", "--config", self.config], log)
        code = process.wait()
        process.end()
        assert code == 1, process.output()
        return process.output()

    def run(self):
        """The runtime with the program of the cell, standing at some scan."""
        image = self.folder / "tank.swb"
        self.ask("compile", self.folder / "tank.st", "-o", image)
        self.runtime = self.start_runtime()
        self.ask("download", image, "--config", self.config, "--replace")
        self.step(0)  # it stands before it is started: else it would run as far as the machine lets it until we step
        self.ask("start", "--config", self.config)
        self.step(1)
        return self

    @staticmethod
    def ask(*arguments):
        done = stepwright(*arguments)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    def step(self, scans):
        text = self.ask("step", str(scans), "--config", self.config)
        self.scan = int(re.search(r"after scan (\d+)", text).group(1))
        return text

    def step_to(self, scan):
        assert scan > self.scan, f"it stands at {self.scan} already"
        return self.step(scan - self.scan)

    def values(self, *names):
        text = self.ask("watch", *names, "--config", self.config, "--count", "1")
        found = dict(re.findall(r"(\S+) = (\S+)", text))
        return [found[name] for name in names]

    def plant_processes(self, count):
        """The plants that the runtime has started: each below a process that stands over it."""
        pids = [plant for over in children(self.runtime.pid) for plant in children(over)]
        assert len(pids) == count, pids
        return pids

    def plant_process(self):
        return self.plant_processes(1)[0]


def children(pid):
    return [int(each) for each in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()]


def gone(pid):
    """A process that is no more, or that nobody has waited for yet."""
    def look():
        try:
            text = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="ascii")
        except OSError:
            return True
        return text.rsplit(")", 1)[1].split()[0] == "Z"
    return eventually(look)


def compile_c(cell):
    subprocess.run([os.environ.get("CC", "cc"), "-O2", "-o", cell.folder / "tank", cell.folder / "tank.c"], check=True)
