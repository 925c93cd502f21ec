"""`stepwright plan`: its progress, its JSON, its threads, the end of its memory."""

import json
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from cell_process import STEPWRIGHT, TIMEOUT_S, stepwright

CELL = pathlib.Path(__file__).parent
KEYS = {"outcome", "plan", "plan_steps", "plan_cost", "bound", "proved_optimal", "first_plan_ms", "wall_ms",
        "expanded", "peak_mb"}


def line(stations, items):
    """Items of three kinds move along a line of stations, one at a time or, for less, two: a first plan at once, and no
    proof for a long time, as bounds think of halves of pairs while the number of items is odd."""
    names = [[f"({kind}{i})" for i in range(stations)] for kind in "abc"]
    every = [name for row in names for name in row]
    actions = "".join(
        f"(:action move-{count}-{row[i][1:-1]} :parameters () :precondition (>= {row[i]} {count})"
        f" :effect (and (decrease {row[i]} {count}) (increase {row[i + 1]} {count}) (increase (cost) {cost})))"
        for row in names for i in range(stations - 1) for count, cost in ((1, 2), (2, 3)))
    start = " ".join(f"(= {name} {items if name in [row[0] for row in names] else 0})" for name in every)
    goal = " ".join(f"(= {row[-1]} {items})" for row in names)
    domain = f"(define (domain d) (:requirements :numeric-fluents) (:functions (cost) {' '.join(every)}) {actions})"
    problem = (f"(define (problem p) (:domain d) (:init (= (cost) 0) {start}) (:goal (and {goal}))"
               f"(:metric minimize (cost)))")
    return domain, problem


class PlanCommand(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        domain, problem = line(6, 13)
        (self.folder / "domain.pddl").write_text(domain, encoding="utf-8")
        (self.folder / "problem.pddl").write_text(problem, encoding="utf-8")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def plan(self, folder, *options):
        file = self.folder / "outcome.json"
        result = stepwright("plan", folder / "domain.pddl", folder / "problem.pddl", "--json", file, *options)
        return result, json.loads(file.read_text(encoding="utf-8"))

    def test_the_bench_on_either_number_of_threads(self):
        plans = []
        for threads in ("1", "1", "2"):
            result, outcome = self.plan(CELL, "--threads", threads, "--optimal")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertLessEqual(KEYS, outcome.keys())
            self.assertEqual((outcome["plan_cost"], outcome["plan_steps"], outcome["proved_optimal"]), (108, 17, True))
            plans.append(outcome["plan"])
        self.assertEqual(plans[0], plans[1])

    def test_no_progress_unless_asked_for(self):
        result, _ = self.plan(self.folder, "--time", "1.5")
        self.assertEqual(result.returncode, 0)
        self.assertNotIn("states", result.stderr)

    def test_progress_lines(self):
        result, outcome = self.plan(self.folder, "--time", "2.5", "--progress")
        self.assertEqual(result.returncode, 0)
        lines = [line for line in result.stderr.splitlines() if re.match(r"\d+ s: ", line)]
        self.assertGreaterEqual(len(lines), 1, result.stderr)
        for line in lines:
            self.assertRegex(line, r"^\d+ s: best [\d.]+ in \d+ steps(, bound [\d.]+)?, \d+ states, \d+ MB$")
        self.assertEqual(outcome["outcome"], "exhausted")
        self.assertGreater(outcome["plan_steps"], 0)

    def test_the_end_of_the_memory_leaves_the_best_plan(self):
        for threads in ("1", "2"):
            result, outcome = self.plan(self.folder, "--time", "1000", "--memory", "8", "--threads", threads)
            self.assertEqual(result.returncode, 0)
            self.assertIn("memory", outcome["reason"])
            self.assertGreater(outcome["plan_steps"], 0)
            self.assertLess(outcome["peak_mb"], 12)

    def test_an_interruption_leaves_the_best_plan(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            file = self.folder / "outcome.json"
            command = [STEPWRIGHT, "plan", self.folder / "domain.pddl", self.folder / "problem.pddl", "--time", "100",
                       "--progress", "--json", file, "--out", self.folder / "best.plan"]
            with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as planner:
                while "best" not in planner.stderr.readline():
                    self.assertIsNone(planner.poll())
                planner.send_signal(number)
                stdout, stderr = planner.communicate(timeout=TIMEOUT_S)
            self.assertEqual(planner.returncode, 0, stderr)
            self.assertIn("interrupted", stderr)
            outcome = json.loads(file.read_text(encoding="utf-8"))
            self.assertEqual(outcome["outcome"], "cancelled")
            self.assertLess(outcome["wall_ms"], 90_000)
            self.assertTrue(stdout.startswith(outcome["plan"][0]))
            valid = stepwright("validate", self.folder / "domain.pddl", self.folder / "problem.pddl",
                               self.folder / "best.plan", "--quiet")
            self.assertEqual(valid.returncode, 0, valid.stderr)

    def test_a_plan_is_in_its_file_as_soon_as_it_is_found(self):
        file = self.folder / "best.plan"
        command = [STEPWRIGHT, "plan", self.folder / "domain.pddl", self.folder / "problem.pddl", "--time", "100",
                   "--out", file]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL) as planner:
            while not file.exists():
                self.assertIsNone(planner.poll())
                time.sleep(0.005)
            planner.kill()
        valid = stepwright("validate", self.folder / "domain.pddl", self.folder / "problem.pddl", file, "--quiet")
        self.assertEqual(valid.returncode, 0, valid.stderr)

    def test_the_first_plan_is_enough_if_so_wanted(self):
        result, outcome = self.plan(self.folder, "--first", "--time", "100")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((outcome["outcome"], outcome["proved_optimal"]), ("solved", False))
        self.assertGreater(outcome["plan_steps"], 0)
        both = stepwright("plan", self.folder / "domain.pddl", self.folder / "problem.pddl", "--first", "--optimal")
        self.assertEqual(both.returncode, 2)

    def test_what_cannot_be_written_or_drawn_is_said_before_the_search(self):
        for option, value, code in (("--out", "/nonexistent/plan", "E0002"), ("--json", self.folder, "E0002"),
                                    ("--svg", "/nonexistent/picture.svg", "E0002"),
                                    ("--binding", self.folder / "none.toml", "B0001")):
            options = (option, value) if option != "--binding" else ("--svg", self.folder / "p.svg", option, value)
            result = stepwright("plan", self.folder / "domain.pddl", self.folder / "problem.pddl", *options)
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, rf"{value}: {code}: .*\n  hint: ")
            self.assertEqual(result.stdout, "")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["domain.pddl", "problem.pddl"])

    def test_streams_take_the_outcome_as_it_is(self):
        bench = (CELL / "domain.pddl", CELL / "problem.pddl")
        result = stepwright("plan", *bench, "--optimal", "--json", "/dev/stdout")
        plan, outcome = result.stdout.split("{", 1)
        self.assertEqual(json.loads("{" + outcome)["plan_cost"], 108)
        self.assertIn("(move v1 a1 f1)", plan)
        with open("/dev/full", "wb") as full:
            result = subprocess.run([STEPWRIGHT, "plan", *bench], stdout=full, stderr=subprocess.PIPE, text=True,
                                    timeout=TIMEOUT_S, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output", result.stderr)
        # Without a standard output the plan's file must not become it.
        out = self.folder / "out.plan"
        shell = f"exec {STEPWRIGHT} plan {bench[0]} {bench[1]} --out {out} >&-"
        self.assertEqual(subprocess.run(shell, shell=True, timeout=TIMEOUT_S, check=False).returncode, 0)
        self.assertEqual(len(out.read_text(encoding="utf-8").splitlines()), 18)

    def test_numbers_that_are_no_limits(self):
        for option, value in (("--time", "-1"), ("--time", "nan"), ("--time", "inf"), ("--time", "1e300"),
                              ("--memory", "-5"), ("--memory", "0"), ("--threads", "0")):
            result = stepwright("plan", CELL / "domain.pddl", CELL / "problem.pddl", option, value)
            self.assertEqual(result.returncode, 2, (option, value))
            self.assertIn(option, result.stderr)

    def test_threads_are_one_or_two(self):
        result = stepwright("plan", CELL / "domain.pddl", CELL / "problem.pddl", "--threads", "3")
        self.assertEqual(result.returncode, 2)


if __name__ == "__main__":
    unittest.main()
