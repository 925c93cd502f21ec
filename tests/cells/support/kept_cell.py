"""A cell that `stepwright up` keeps, for tests: its folder, its processes by what `status` says, always ended."""

import json
import os
import pathlib
import re
import shutil
import tempfile

from processes import NO_PLANT, STEPWRIGHT, Process, eventually, stepwright

PROGRAM = """\
PROGRAM Main
  VAR lamp AT %QX0.0 : BOOL; n : UDINT; END_VAR
  n := n + 1;
  lamp := TRUE;
END_PROGRAM
"""
PAGE = '[hmi]\nport = 0\nanonymous = "viewer"\n'
# Nobody listens on port 1: the device is never there, and the client goes on trying.
DEVICES = PAGE + """\
[clock]
mode = "real"
[runtime]
sources = ["main.st"]
[io]
kind = "modbus"
[[modbus.device]]
name = "tank"
host = "127.0.0.1"
port = 1
[[modbus.device.group]]
tags = [ { name = "lamp", address = "%QX0.0", coil = 0 } ]
"""
RUNS = '[clock]\nmode = "real"\n[runtime]\nsources = ["main.st"]\nautostart = true\n'


def alive(pid):
    """A process that is there and no zombie."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class KeptCell:
    """`more` is what its file has beside its name and folder; `config` names a file of the tree instead."""

    def __init__(self, more=NO_PLANT + RUNS + PAGE, program=PROGRAM, config=None, domain=96, command=STEPWRIGHT):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        self.state = self.folder / "state"
        self.command = command
        self.processes = []
        self.sets = []
        if config is None:
            config = self.folder / "cell.toml"
            config.write_text(f'[cell]\nname = "kept-{os.getpid()}"\nstate_dir = "state"\n[dds]\ndomain_id = {domain}\n{more}',
                              encoding="utf-8")
            (self.folder / "main.st").write_text(program, encoding="utf-8")
        else:
            self.sets = ["--set", f'cell.state_dir="{self.state}"', "--set", "hmi.port=0", "--set", f"dds.runtime_id=kept-{os.getpid()}"]
        self.config = config

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.end()
        shutil.rmtree(self.folder, ignore_errors=True)

    def up(self, *arguments):
        """Starts it; does not wait."""
        log = self.folder / f"up{len(self.processes)}.log"
        process = Process([self.command, "up", self.config, *self.sets, *arguments], log)
        self.processes.append(process)
        return process

    def ready(self, *arguments):
        process = self.up(*arguments)
        process.wait_for(r"the cell '.*' is ready: http://")
        return process

    def run(self, command, *arguments):
        """`status` or `down` to its end."""
        return stepwright(command, self.config, *self.sets, *arguments)

    def status(self):
        return json.loads(self.run("status", "--json").stdout)

    def of(self, name):
        """What is known of one process; none before the cell comes up."""
        return next((each for each in self.status()["processes"] if each["name"] == name), None)

    def pids(self):
        return {each["name"]: each["pid"] for each in self.status()["processes"]}

    def nothing_is_left(self, pids):
        """None of the processes lives on, and the cell counts as not up."""
        gone = eventually(lambda: not any(alive(pid) for pid in pids if pid))
        return gone and self.status()["pid"] == 0

    def port(self):
        return int(re.search(r":(\d+)/", self.status()["address"]).group(1))
