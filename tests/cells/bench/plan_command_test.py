"""`stepwright plan`: its progress, its JSON, its threads, the end of its memory."""

import json
import pathlib
import re
import shutil
import tempfile
import unittest

from cell_process import stepwright

CELL = pathlib.Path(__file__).parent
KEYS = {"outcome", "plan", "plan_steps", "plan_cost", "bound", "proved_optimal", "first_plan_ms", "wall_ms",
        "expanded", "peak_mb"}


def line(stations, items):
    """Items of three kinds move along a line of stations: a first plan at once, no proof for a long time."""
    names = [[f"({kind}{i})" for i in range(stations)] for kind in "abc"]
    every = [name for row in names for name in row]
    actions = "".join(
        f"(:action move-{row[i][1:-1]} :parameters () :precondition (>= {row[i]} 1) :effect (and (decrease {row[i]} 1)"
        f"(increase {row[i + 1]} 1) (increase (cost) 2)))" for row in names for i in range(stations - 1))
    start = " ".join(f"(= {name} {items if name in [row[0] for row in names] else 0})" for name in every)
    goal = " ".join(f"(= {row[-1]} {items})" for row in names)
    domain = f"(define (domain d) (:requirements :numeric-fluents) (:functions (cost) {' '.join(every)}) {actions})"
    problem = (f"(define (problem p) (:domain d) (:init (= (cost) 0) {start}) (:goal (and {goal}))"
               f"(:metric minimize (cost)))")
    return domain, problem


class PlanCommand(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        domain, problem = line(6, 12)
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
            result, outcome = self.plan(CELL, "--threads", threads)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertLessEqual(KEYS, outcome.keys())
            self.assertEqual((outcome["plan_cost"], outcome["plan_steps"], outcome["proved_optimal"]), (108, 17, True))
            plans.append(outcome["plan"])
        self.assertEqual(plans[0], plans[1])

    def test_no_progress_unless_asked_for(self):
        result, _ = self.plan(self.folder, "--time", "1.5")
        self.assertEqual(result.returncode, 4)
        self.assertNotIn("states", result.stderr)

    def test_progress_lines(self):
        result, outcome = self.plan(self.folder, "--time", "2.5", "--progress")
        self.assertEqual(result.returncode, 4)
        lines = [line for line in result.stderr.splitlines() if re.match(r"\d+ s: ", line)]
        self.assertGreaterEqual(len(lines), 1, result.stderr)
        for line in lines:
            self.assertRegex(line, r"^\d+ s: best [\d.]+ in \d+ steps(, bound [\d.]+)?, \d+ states, \d+ MB$")
        self.assertEqual(outcome["outcome"], "exhausted")
        self.assertGreater(outcome["plan_steps"], 0)

    def test_the_end_of_the_memory_leaves_the_best_plan(self):
        for threads in ("1", "2"):
            result, outcome = self.plan(self.folder, "--time", "60", "--memory", "8", "--threads", threads)
            self.assertEqual(result.returncode, 4)
            self.assertIn("memory", outcome["reason"])
            self.assertGreater(outcome["plan_steps"], 0)
            self.assertLess(outcome["peak_mb"], 12)

    def test_threads_are_one_or_two(self):
        result = stepwright("plan", CELL / "domain.pddl", CELL / "problem.pddl", "--threads", "3")
        self.assertEqual(result.returncode, 2)


if __name__ == "__main__":
    unittest.main()
