"""A guest under QEMU with Debian's kernel, whose serial ports are the kernel's own (8250 driver), and in it the programs of
the build. Emulated without the help of the processor, so that it is the same on every machine."""

import os
import pathlib
import re
import shutil
import socket
import subprocess
import time

from processes import BIN, Process, eventually

KERNEL = os.environ["STEPWRIGHT_GUEST_KERNEL"]
PATIENCE_S = 300  # it is emulated, and so ten times slower than the machine that it is on
LIBRARY = re.compile(r"(?:=> )?(/\S+) \(0x")

# The line of the console is a loop of commands: each is answered with what it says and how it ended.
INIT = """\
#!/bin/busybox sh
/bin/busybox --install -s /bin
mount -t devtmpfs dev /dev
mkdir -p /dev/shm
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t tmpfs tmp /tmp
mount -t tmpfs shm /dev/shm
ip link set lo up
stty -F /dev/ttyS0 raw -echo
exec </dev/ttyS0 >/dev/ttyS0 2>/dev/ttyS0
echo "<<guest is up>>"
while read -r command; do
  eval "$command" </dev/null >/tmp/said 2>&1
  code=$?
  cat /tmp/said
  echo "<<ended $code>>"
done
"""


def libraries_of(programs):
    found = set()
    for program in programs:
        said = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
        found.update(LIBRARY.findall(said))
    return found


class Guest:
    """Guest(folder, ["modbus-client"], {"cell.toml": text}, ports): `ports` are QEMU's options for devices."""

    def __init__(self, folder, commands, files, options):
        self.folder = folder
        self.console_text = ""
        self.make_root(folder / "root", commands, files)
        begin = time.monotonic()
        self.qemu = Process(
            ["qemu-system-x86_64", "-accel", "tcg", "-m", "256", "-nodefaults", "-no-user-config", "-display", "none", "-no-reboot",
             "-kernel", KERNEL, "-initrd", folder / "initrd", "-append", "console=ttyS0 loglevel=1 panic=-1",
             "-chardev", f"socket,id=console,path={folder}/console,server=on,wait=off", "-serial", "chardev:console",
             "-monitor", f"unix:{folder}/monitor,server=on,wait=off", *options], folder / "qemu.log")
        self.console = self.connect("console")
        self.monitor = self.connect("monitor")
        self.ask_monitor("")
        self.read_until(r"<<guest is up>>\r?\n")
        self.boot_s = time.monotonic() - begin

    def make_root(self, root, commands, files):
        programs = [BIN / "stepwright", *(BIN / f"stepwright-{each}" for each in commands)]
        for each in ("bin", "dev", "proc", "sys", "tmp", "cell"):
            (root / each).mkdir(parents=True)
        shutil.copy("/bin/busybox", root / "bin")
        for program in programs:
            subprocess.run(["strip", "-o", root / "bin" / program.name, program], check=True)
        for library in libraries_of(programs):
            place = root / library[1:]
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(library, place)
        for name, content in files.items():
            (root / "cell" / name).write_bytes(content)
        (root / "init").write_text(INIT, encoding="ascii")
        (root / "init").chmod(0o755)
        names = "\n".join(str(each.relative_to(root)) for each in sorted(root.rglob("*")))
        with open(self.folder / "initrd", "wb") as image:
            subprocess.run(["cpio", "-o", "-H", "newc", "--quiet"], cwd=root, input=names.encode(), stdout=image, check=True)

    def connect(self, name):
        def attempt():
            assert self.qemu.running(), self.qemu.output()
            end = socket.socket(socket.AF_UNIX)
            if end.connect_ex(str(self.folder / name)) == 0:
                return end
            end.close()
            return None
        end = eventually(attempt)
        assert end, "QEMU does not listen: " + self.qemu.output()
        end.settimeout(PATIENCE_S)
        return end

    def read_until(self, pattern):
        """What the guest says up to the pattern; the match."""
        deadline = time.monotonic() + PATIENCE_S
        while True:
            found = re.search(pattern, self.console_text)
            if found:
                said, self.console_text = self.console_text[:found.start()], self.console_text[found.end():]
                return said.replace("\r", ""), found
            more = self.console.recv(4096) if time.monotonic() < deadline else b""
            assert more, f"the guest never said {pattern}: {self.console_text}\n{self.qemu.output()}"
            self.console_text += more.decode("utf-8", "replace")

    def run(self, command):
        """A line of the guest's shell: its exit code, and what it says."""
        self.console.sendall(command.encode() + b"\n")
        said, found = self.read_until(r"<<ended (\d+)>>\r?\n")
        return int(found.group(1)), said

    def say(self, command):
        code, said = self.run(command)
        assert code == 0, f"{command}: {code}\n{said}"
        return said

    def start(self, command, config):
        """A command of ours in the background; the name of its log."""
        log = f"/tmp/{command}.log"
        self.say(f"stepwright {command} --config {config} >{log} 2>&1 & echo $! >/tmp/{command}.pid")
        return log

    def stop(self, command, signal="TERM"):
        pid = f"/tmp/{command}.pid"
        self.run(f"[ -e {pid} ] && kill -{signal} $(cat {pid}) && wait $(cat {pid}); rm -f {pid}")

    def wait_for(self, log, text):
        found = eventually(lambda: self.run(f"grep -q '{text}' {log}")[0] == 0, PATIENCE_S, 0.05)
        assert found, f"'{text}' is not in {log}:\n" + self.run(f"cat {log}")[1]

    def ask_monitor(self, command):
        """A command of QEMU's monitor, which ends what it says with its prompt."""
        if command:
            self.monitor.sendall(command.encode() + b"\n")
        said = b""
        while not said.endswith(b"(qemu) "):
            said += self.monitor.recv(4096)
        return said.decode("utf-8", "replace")

    def close(self):
        self.qemu.end()
        self.console.close()
        self.monitor.close()
