"""A Debian that has nothing but what is essential and apt, in a folder, for tests of packages. Needs root and the mirror."""

import pathlib
import shutil
import subprocess
import tempfile

# With processes, devices and shared memory of its own, which end with the command.
ENTER = ('mount -t proc proc "$0/proc" && mkdir -p "$0/dev/shm" && mount -t tmpfs tmpfs "$0/dev/shm" && root=$0 && '
         'exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive '
         'chroot "$root" "$@"')
ALONE = f"ip link set lo up && {ENTER}"


class CleanRoot:
    def __init__(self, suite="bookworm"):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-root-"))
        self.folder.chmod(0o755)  # it becomes everybody's "/"
        try:
            self._call("debootstrap", "--variant=minbase", suite, self.folder)
        except AssertionError:
            self.remove()
            raise

    def run(self, *command, network=False):
        """A command in it, with a loopback interface and nothing else unless it needs the mirror."""
        spaces = ["unshare", "--mount", "--pid", "--ipc", "--fork", "--kill-child", *([] if network else ["--net"])]
        return subprocess.run([*spaces, "sh", "-c", ENTER if network else ALONE, self.folder, *map(str, command)],
                              capture_output=True, text=True, check=False)

    def apt(self, *arguments):
        done = self.run("apt-get", "-y", "-q", *arguments, network=True)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout + done.stderr

    def take(self, package):
        """Copies a package of this machine into the root; its path there, as apt takes it."""
        shutil.copy(package, self.folder / package.name)
        return f"/{package.name}"

    def remove(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    @staticmethod
    def _call(*command):
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
