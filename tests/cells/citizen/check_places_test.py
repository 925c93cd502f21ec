"""`stepwright check`: what a cell is to write, and cannot."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from processes import PATIENCE_S, STEPWRIGHT, stepwright

CELL = """\
[cell]
name = "line"
state_dir = "{state}"
[runtime]
sources = ["main.st"]
[plant]
kind = "none"
{more}
"""
PROGRAM = "PROGRAM Main\n  VAR n : INT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
NOBODY = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")


class CheckPlaces(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.folder.chmod(0o755)
        (self.folder / "main.st").write_text(PROGRAM, encoding="utf-8")

    def check(self, more="", state="state", prefix=()):
        (self.folder / "cell.toml").write_text(CELL.format(more=more, state=state), encoding="utf-8")
        done = subprocess.run([*prefix, STEPWRIGHT, "check"], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        self.assertIn(done.returncode, (0, 1), done.stderr)  # and does not abort
        return done

    def test_a_file_that_is_a_folder_or_has_none_is_told(self):
        for table, key, value, why in [
                ("retain", "file", ".", "is a folder"), ("retain", "file", "nix/da.store", "nix is not there"), ("log", "file", ".", "is a folder"),
                ("log", "file", "nix/da.log", "its folder nix is not there"), ("record", "file", "nix/da.rec", "nix is not there"),
                ("record", "file", "../main.st/x.rec", "is no folder")]:
            with self.subTest(f"{table} {value}"):
                done = self.check(f'[{table}]\n{key} = "{value}"\n')
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertRegex(done.stderr, rf"cell\.toml:9:\d+: C0476: \[{table}\] {key} cannot be written: .*{why}\n  hint: ")

    def test_a_folder_that_is_a_file_or_cannot_be_is_told(self):
        long = "x" * 300
        for table, key, value, why in [
                ("hmi", "screens_dir", "main.st", "main.st is no folder"), ("hmi", "access_dir", "main.st/in", "main.st is no folder"),
                ("history", "folder", "../main.st", "main.st is no folder"), ("hmi", "screens_dir", long, "File name too long"),
                ("hmi", "access_dir", long, "File name too long"), ("history", "folder", long, "File name too long")]:
            with self.subTest(f"{table} {key} {value[:20]}"):
                done = self.check(f'[{table}]\n{key} = "{value}"\n')
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertRegex(done.stderr, rf"cell\.toml:9:\d+: C0476: \[{table}\] {key} cannot be written: .*{why}")

    def test_what_a_start_makes_is_sound(self):
        for more in ("", '[retain]\nfile = "r.store"\n[record]\nfile = "run.rec"\n[history]\nfolder = "deep/history"\n[log]\nfile = "cell.log"\n'
                     '[hmi]\nscreens_dir = "my/screens"\naccess_dir = "my/access"\n', '[retain]\nfile = ""\n', '[log]\nfile = "/dev/null"\n'):
            self.assertEqual(self.check(more).stderr, "")

    def test_a_program_into_a_folder_that_is_not_there_is_told(self):
        (self.folder / "cell.toml").write_text(CELL.format(more="", state="state").replace("[plant]", 'program = "nix/line.swb"\n[plant]'), encoding="utf-8")
        self.assertIn("C0476: [runtime] program cannot be written: its folder nix is not there", stepwright("check", cwd=self.folder).stderr)

    def test_a_state_folder_with_a_name_that_no_file_has_is_told(self):
        done = self.check(state="x" * 300)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("cell.toml:3:13: C0462: ", done.stderr)
        self.assertNotIn("C0476", done.stderr, "it is said once")

    def test_a_state_folder_that_nobody_can_make_is_told_once(self):
        for place, other in (("/proc/nix", "/sys/nix"), ("/sys/nix/deep", "/proc/nix/deep")):
            done = self.check(f'[history]\nfolder = "deep/history"\n[hmi]\nscreens_dir = "{other}"\n', state=place)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertRegex(done.stderr, rf"cell\.toml:3:13: C0476: \[cell\] state_dir cannot be written: nothing can be made in {place[:5].rstrip('/')}")
            self.assertRegex(done.stderr, rf"C0476: \[hmi\] screens_dir cannot be written: nothing can be made in {other[:5].rstrip('/')}")
            self.assertEqual(done.stderr.count("C0476"), 2, done.stderr)

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("setpriv"), "needs root, to become another user")
    def test_a_state_folder_that_this_user_may_not_read_is_a_warning(self):
        (self.folder / "state").mkdir(mode=0o700)
        done = self.check('[log]\nfile = "cell.log"\n', prefix=NOBODY)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"cell\.toml:3:13: warning: C0476: this user may not look into the state folder state: Permission denied")
        self.assertRegex(done.stderr, r"cell\.toml:9:8: warning: C0476: \[log\] file cannot be written: this user may not write .*: Permission denied")

    def test_tls_files_that_are_none_are_told(self):
        done = self.check('[hmi]\ntls_certificate = "main.st"\ntls_key = "main.st"\n')
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("main.st: H0003: TLS cannot be set up", done.stderr)


if __name__ == "__main__":
    unittest.main()
