"""A cell whose runtime is served over Modbus by the real processes, with the inputs that all slaves of these tests have."""

import os
import pathlib
import shutil
import subprocess
import tempfile

from processes import PATIENCE_S, TESTS, Cell, Process, eventually, stepwright

HERE = pathlib.Path(__file__).parent
PORT = 1502
BYTES = 256
AREA = f"modbus-interop-{os.getpid()}"  # /dev/shm is one for all tests that run at a time
CELL = f"""
[clock]
mode = "real"
[plant]
kind = "none"
[io]
kind = "shared_memory"
name = "{AREA}"
[image]
input_bytes = {BYTES}
output_bytes = {BYTES}
[modbus.server]
enabled = true
port = {PORT}
writable = true
"""
EVERYBODY = """
[[modbus.server.client]]
address = "0.0.0.0/0"
read = ["all"]
write = ["all"]
"""


class Served(Cell):
    """Runtime, plant and Modbus server, with a program that is running."""

    def __init__(self, more=EVERYBODY):
        super().__init__(CELL + more)
        self.area = pathlib.Path(f"/dev/shm/stepwright-io-{AREA}")
        self.area.unlink(missing_ok=True)

    def __exit__(self, *what):
        super().__exit__(*what)
        self.area.unlink(missing_ok=True)

    def start_all(self):
        plant = Process([TESTS / "modbus_interop_plant", AREA, str(BYTES)], self.folder / "plant.log")
        self.processes.append(plant)
        plant.wait_for("ready")
        runtime = self.start_runtime()
        image = self.folder / "interop.swb"
        for command in (("compile", HERE / "interop.st", "-o", image),
                        ("download", "--config", self.config, image, "--replace"), ("start", "--config", self.config)):
            done = stepwright(*command)
            assert done.returncode == 0, done.stdout + done.stderr
        return runtime, self.start_server()

    def start_server(self):
        server = self.start("modbus-server")
        server.wait_for("listens on")
        return server

    def answers(self):
        """Waits until the server has found the runtime's program."""
        def ask():
            done = subprocess.run(["mbpoll", "-m", "tcp", "-p", str(PORT), "-0", "-1", "-t", "4", "-r", "0", "127.0.0.1"],
                                  capture_output=True, text=True, timeout=PATIENCE_S, check=False)
            return done.returncode == 0
        assert eventually(ask), "the server never answered"


def temporary_folder(test):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-interop-"))
    test.addCleanup(shutil.rmtree, folder, True)
    return folder
