"""The parts of a run (parts.py): eight runs that pass have had every program, and a part can be asked for."""

import pathlib
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "support")]
import parts  # noqa: E402
import programs_test as programs  # noqa: E402


class Parts(unittest.TestCase):
    def test_eight_runs_in_a_row_take_every_program_once(self) -> None:
        names = [f"tests/st/programs/tour/{number}.st" for number in range(1000)]
        with tempfile.TemporaryDirectory() as folder:
            state = pathlib.Path(folder) / "part"
            taken: list[str] = []
            for _ in range(parts.PARTS):
                part = parts.next_part(HERE, state)
                state.write_text(f"{part}\n", encoding="utf-8")
                chosen = [name for name in names if programs.in_part(name, part)]
                self.assertGreater(len(chosen), len(names) // (2 * parts.PARTS))
                taken += chosen
        self.assertEqual(sorted(taken), sorted(names))

    def test_a_new_build_folder_begins_somewhere(self) -> None:
        for root in (HERE, pathlib.Path("/")):  # with git and without
            self.assertIn(parts.next_part(root, HERE / "absent"), range(1, parts.PARTS + 1))

    def test_a_part_or_all_may_be_asked_for(self) -> None:
        self.assertEqual(parts.asked_part("3"), 3)
        self.assertIsNone(parts.asked_part("all"))
        self.assertTrue(programs.in_part("any.st", None))
        for wrong in ("0", "9", "half", "03"):
            with self.assertRaisesRegex(SystemExit, "all, or 1 to 8"):
                parts.asked_part(wrong)


if __name__ == "__main__":
    unittest.main()
