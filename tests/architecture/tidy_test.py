"""tidy.py and changed_files.py in a repository made for it: what counts as changed, and that a fault in it is found."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
from changed_files import changed_files, changed_lines  # noqa: E402

FAULT = "#include <vector>\nbool f(const std::vector<int>& x) { return x.size() == 0; }\n"
SOUND = "#include <vector>\nbool f(const std::vector<int>& x) { return x.empty(); }\n"


class Repository(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        self.asked = {name: os.environ.pop(name, None) for name in ("STEPWRIGHT_BASE", "STEPWRIGHT_LONG")}
        self.git("init", "-q", "-b", "main")
        self.git("config", "user.name", "test")
        self.git("config", "user.email", "test@localhost")
        self.commit("old.cpp", FAULT)

    def tearDown(self) -> None:
        for name, value in self.asked.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value

    def git(self, *command: str) -> str:
        return subprocess.run(["git", "-C", str(self.root), *command], capture_output=True, check=True, text=True).stdout.strip()

    def commit(self, name: str, text: str) -> str:
        (self.root / name).write_text(text, encoding="utf-8")
        self.git("add", name)
        self.git("commit", "-q", "-m", name)
        return self.git("rev-parse", "HEAD")

    def tidy(self, *what: str) -> subprocess.CompletedProcess:
        (self.root / ".clang-tidy").write_bytes((HERE.parents[1] / ".clang-tidy").read_bytes())
        build = self.root / ".git" / "build"
        build.mkdir(exist_ok=True)
        command = f"c++ -std=c++20 -I{self.root} -o CMakeFiles/all.dir/new.o -c new.cpp"
        (build / "compile_commands.json").write_text(json.dumps([{"command": command}]), encoding="utf-8")
        return subprocess.run([sys.executable, HERE / "tidy.py", "--root", self.root, "--build", build, *what],
                              capture_output=True, text=True)

    def test_without_history_nothing_is_known(self) -> None:
        self.assertIsNone(changed_files(self.root))
        self.assertIsNone(changed_files(self.root / ".git"))
        done = self.tidy("--changed")
        self.assertEqual((done.returncode, done.stdout), (0, "git tells of no commit before this one: nothing to compare with\n"))

    def test_commits_and_what_is_not_committed_count_the_newest_first(self) -> None:
        self.commit("first.cpp", SOUND)
        self.commit("second.cpp", SOUND)
        (self.root / "first.cpp").write_text(FAULT, encoding="utf-8")
        (self.root / "added.cpp").write_text(SOUND, encoding="utf-8")
        self.assertEqual(changed_files(self.root), ["added.cpp", "first.cpp", "second.cpp"])

    def test_a_branch_begins_at_its_merge_base_and_a_base_may_be_asked_for(self) -> None:
        base = self.commit("first.cpp", SOUND)
        self.git("update-ref", "refs/remotes/origin/main", base)
        second = self.commit("second.cpp", SOUND)
        self.commit("third.cpp", SOUND)
        self.assertEqual(changed_files(self.root), ["third.cpp", "second.cpp"])
        os.environ["STEPWRIGHT_BASE"] = second
        self.assertEqual(changed_files(self.root), ["third.cpp"])

    def test_of_many_commits_on_the_main_branch_the_last_ten_count(self) -> None:
        for number in range(12):
            self.commit(f"{number}.cpp", SOUND)
        self.assertEqual(changed_files(self.root), [f"{number}.cpp" for number in range(11, 1, -1)])

    def test_in_the_long_mode_all_since_the_last_release_count(self) -> None:
        self.git("tag", "v1")
        for number in range(12):
            self.commit(f"{number}.cpp", SOUND)
        os.environ["STEPWRIGHT_LONG"] = "1"
        self.assertEqual(changed_files(self.root), [f"{number}.cpp" for number in range(11, -1, -1)])

    def test_the_newest_files_are_looked_at_and_in_the_long_mode_all(self) -> None:
        self.git("tag", "v1")
        for number in range(6):
            self.commit(f"{number}.cpp", SOUND)
        short = self.tidy("--changed")
        self.assertEqual((short.returncode, short.stdout.strip().splitlines()[-1]),
                         (0, "4 files of 6 that changed, the newest first (2 are left out: STEPWRIGHT_LONG=1 takes all): 0 with findings"))
        os.environ["STEPWRIGHT_LONG"] = "1"
        whole = self.tidy("--changed")
        self.assertEqual((whole.returncode, whole.stdout.strip().splitlines()[-1]),
                         (0, "6 files of 6 that changed, the newest first: 0 with findings"))

    def test_lines_of_a_file_that_moved_are_those_that_are_new_in_it(self) -> None:
        text = "".join(f"int f{number}();\n" for number in range(40))
        self.commit("here.h", text)
        os.environ["STEPWRIGHT_BASE"] = self.git("rev-parse", "HEAD")
        self.git("mv", "here.h", "there.h")
        self.commit("there.h", '#include "x.h"\n' + text.replace("f7()", "g7()\nint h7()") + "int last();\n")
        self.assertEqual(changed_lines(self.root, "there.h"), [(9, 10), (43, 43)])
        (self.root / "new.h").write_text("int a();\nint b();\n", encoding="utf-8")
        self.assertEqual(changed_lines(self.root, "new.h"), [(1, 2)])

    def test_an_old_fault_in_a_file_that_changed_is_left_alone(self) -> None:
        os.environ["STEPWRIGHT_BASE"] = self.git("rev-parse", "HEAD~0")
        self.commit("old.cpp", FAULT + "int more();\n")
        done = self.tidy("--changed")
        self.assertEqual((done.returncode, done.stdout.strip().splitlines()[-1]),
                         (0, "1 files of 1 that changed, the newest first: 0 with findings"), done.stdout)

    def test_a_fault_in_what_changed_is_found_and_an_old_one_when_asked_for(self) -> None:
        self.commit("new.cpp", SOUND)
        done = self.tidy("--changed")
        self.assertEqual((done.returncode, done.stdout.strip().splitlines()[-1]),
                         (0, "1 files of 1 that changed, the newest first: 0 with findings"), done.stdout)
        self.commit("new.cpp", FAULT)
        for what, name in (("--changed", "new.cpp"), ("old.cpp", "old.cpp")):
            done = self.tidy(what)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stdout, name + r":2:.*readability-container-size-empty")


if __name__ == "__main__":
    unittest.main()
