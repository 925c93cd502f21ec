"""links.py on libraries made for it: what it accepts, and what it says of each that declares too little."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

COMPILER = sys.argv.pop() if len(sys.argv) > 1 else "c++"


class Links(unittest.TestCase):
    """plan calls floor, floor calls wall, wall calls the mathematics of the C library."""

    SOURCES = {
        "wall": "#include <math.h>\ndouble wall(double x) { return cos(x); }",
        "floor": "double wall(double); double floor_of(double x) { return wall(x); }",
        "plan": "double floor_of(double); double plan(double x) { return floor_of(x); }",
    }

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        here = pathlib.Path(cls.folder.name)
        for name, source in cls.SOURCES.items():
            (here / f"{name}.cpp").write_text(source + "\n", encoding="utf-8")
            subprocess.run([COMPILER, "-c", f"{name}.cpp", "-o", f"{name}.o"], cwd=here, check=True)
            subprocess.run(["ar", "rc", f"lib{name}.a", f"{name}.o"], cwd=here, check=True)
        subprocess.run([COMPILER, "-shared", "-fPIC", "wall.cpp", "-o", "libwall.so"], cwd=here, check=True)

    def judge(self, *, plan: str, floor: str = "wall", wall: str = "libwall.a", libraries: tuple[str, ...] = ("plan", "floor")):
        here = pathlib.Path(self.folder.name)
        lines = [f"plan|{here}/libplan.a|{plan}", f"floor|{here}/libfloor.a|{floor}", f"wall|{here}/{wall}|", "names||floor"]
        (here / "links.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
        script = pathlib.Path(__file__).with_name("links.py")
        return subprocess.run([sys.executable, script, here / "links.txt", COMPILER, *libraries], capture_output=True, text=True)

    def test_what_is_declared_is_enough(self) -> None:
        for plan in ("floor", "names", "wall,floor,m,-pthread"):
            with self.subTest(plan):
                done = self.judge(plan=plan)
                self.assertEqual((done.returncode, done.stdout), (0, "2 libraries link with what they declare\n"), done.stderr)

    def test_a_shared_library_counts_as_well(self) -> None:
        self.assertEqual(self.judge(plan="floor", wall="libwall.so").returncode, 0)

    def test_what_is_not_declared_is_named_with_its_library(self) -> None:
        done = self.judge(plan="wall")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout, "plan (plan.o): needs floor_of(double), which floor has: plan does not declare it\n")

    def test_a_library_that_is_not_declared_may_be_reached_by_nobody_else_either(self) -> None:
        done = self.judge(plan="floor", floor="")
        self.assertEqual(done.stdout, "floor (floor.o): needs wall(double), which wall has: floor does not declare it\n")
        self.assertEqual(done.returncode, 1)

    def test_what_no_library_has_is_told(self) -> None:
        done = self.judge(plan="floor", wall="libplan.a")
        self.assertEqual(done.stdout, "floor (floor.o): needs wall(double), which no library here has\n")
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
