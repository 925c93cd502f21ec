"""What an operator asks for at real processes: a plan that waits for its start, plans that are only looked at while another
one runs, and further runs from where the plant is, over restarts of the supervisor."""

import json
import pathlib
import signal
import time
import unittest

from page import Page
from processes import SOURCES, eventually

BENCH = SOURCES / "tests/cells/bench"
FEWER = "(and\n  (is-at v1 f1)\n  (= (level a1) 3))"
# Far more than the clients of the bench want: the proof of its best plan takes longer than any test.
MUCH = "(and (>= (received c1) (demand c1)) (>= (received c2) (demand c2)) (= (level a1) 5) (= (level a2) 5))"
JOB = """
[clock]
mode = "simulated"
speed = {speed}
[plant]
kind = "tank_bench"
[planning]
domain = "{bench}/domain.pddl"
problem = "{problem}"
binding = "{bench}/binding.toml"
[executive]
start = "operator"
what_if_ms = 300_000
"""


class Bench:
    """All processes of a bench whose runs an operator starts, and the operator."""

    def __init__(self, speed=0.0, change=lambda problem: problem):
        self.page = Page(more=JOB.format(speed=speed, bench=BENCH, problem="problem.pddl"), domain=94)
        self.cell = self.page.cell
        problem = (BENCH / "problem.pddl").read_text(encoding="utf-8")
        (self.cell.folder / "problem.pddl").write_text(change(problem), encoding="utf-8")

    def __enter__(self):
        self.cell.start_runtime()
        self.cell.start("link")
        self.supervise()
        self.page.start()
        self.page.claim()
        assert eventually(lambda: self.page.ask("GET", "/api/plan/outlook").status == 200)
        # Requests find the supervisor a moment later than documents do.
        assert eventually(lambda: self.ask("/api/plan/what-if/cancel") != (503, "D0001"))
        return self

    def __exit__(self, *_):
        self.page.__exit__()

    def supervise(self):
        self.supervisor = self.cell.start("supervisor")

    def ask(self, path, **body):
        """Status and first problem's code of a request to the supervisor."""
        answer = self.page.ask("POST", path, body)
        return answer.status, answer.json["problems"][0]["code"] if answer.status != 200 else ""

    def outlook(self):
        return self.page.ask("GET", "/api/plan/outlook").json

    def answer(self, number):
        """What has come of a what-if once it is no longer planned for; None while it is."""
        told = self.outlook()["what_if"]
        return told if told and told["id"] == number and told["state"] != "planning" else None

    def record(self):
        journal = self.cell.state / "executive.json"
        return json.loads(journal.read_text(encoding="utf-8"))["record"] if journal.exists() else {"phase": ""}

    def reaches(self, phase):
        return eventually(lambda: self.record()["phase"] == phase)

    def runs(self):
        """How many scans there have been."""
        return self.cell.figure("stepwright_scans_total")


class Goals(unittest.TestCase):
    def test_a_plan_waits_for_its_start_and_a_what_if_touches_nothing(self):
        with Bench() as bench:
            self.assertTrue(bench.reaches("ready"), bench.supervisor.output())
            form = bench.page.ask("GET", "/api/plan/goal-form").json
            self.assertEqual(form["objects"]["place"], ["f1", "a1", "a2"])
            self.assertEqual(bench.ask("/api/plan/what-if", goal=FEWER, id="one"), (200, ""))
            told = eventually(lambda: bench.answer("one"))
            self.assertEqual(told["state"], "planned", told)
            self.assertEqual(told["plan"]["steps"], 4)
            self.assertEqual(told["running"]["steps"], 17)
            self.assertEqual(bench.ask("/api/plan/what-if", goal="(= (level a1) 12)", id="two"), (200, ""))
            self.assertEqual(eventually(lambda: bench.answer("two"))["state"], "no_plan")
            refused = bench.page.ask("POST", "/api/plan/what-if", {"goal": "(and\n  (= (level a9) 3))", "id": "three"})
            self.assertEqual(refused.status, 400)
            self.assertEqual(refused.json["problems"][0]["line"], 2)
            # A supervisor that dies while its plan waits leaves nothing that begins by itself.
            bench.supervisor.send(signal.SIGKILL)
            bench.supervise()
            bench.supervisor.wait_for("ready: ")
            time.sleep(0.5)
            self.assertEqual(bench.record()["phase"], "ready")
            self.assertEqual(bench.runs(), 0)

    def test_runs_are_started_one_after_the_other_over_a_restart(self):
        with Bench() as bench:
            self.assertTrue(bench.reaches("ready"), bench.supervisor.output())
            self.assertEqual(bench.ask("/api/plan/start", goal="(= (level a9) 3)")[0], 400)
            self.assertEqual(bench.ask("/api/plan/hold"), (409, "X0008"))
            self.assertEqual(bench.ask("/api/plan/start", goal=FEWER, reason="a small order"), (200, ""))
            self.assertTrue(bench.reaches("done"), bench.supervisor.output())
            self.assertEqual(bench.ask("/api/plan/abort"), (409, "X0008"))
            done = bench.runs()
            bench.supervisor.send(signal.SIGKILL)
            bench.supervise()
            bench.supervisor.wait_for("done: the goal is reached")
            time.sleep(0.5)
            self.assertEqual(bench.runs(), done, "what was over begins by itself")
            goal = "(and (is-at v1 a2) (= (level a1) 6))"
            self.assertTrue(eventually(lambda: bench.ask("/api/plan/start", goal=goal) == (200, "")), bench.supervisor.output())
            bench.supervisor.wait_for("executing: ")
            self.assertTrue(bench.reaches("done"), bench.supervisor.output())
            record = bench.record()
            self.assertEqual(len(record["episodes"]), 1)
            self.assertAlmostEqual(record["observed"]["(level a1)"], 6.0, delta=0.2)
            trail = bench.page.trail.read_text(encoding="utf-8")
            self.assertIn("a small order", trail)
            self.assertIn("plan.start", trail)

    def test_a_run_is_not_held_up_by_a_what_if_that_does_not_end(self):
        def much(problem):
            return problem.replace("(demand c1) 7", "(demand c1) 77").replace("(demand c2) 10", "(demand c2) 95").replace(
                problem[problem.index("(:goal"):problem.index("(:metric")], "(:goal (= (level a1) 3))\n")

        with Bench(change=much) as bench:
            self.assertTrue(bench.reaches("ready"), bench.supervisor.output())
            self.assertEqual(bench.ask("/api/plan/what-if", goal=MUCH, id="long"), (200, ""))
            self.assertEqual(bench.ask("/api/plan/what-if", goal=FEWER, id="other"), (409, "X0008"))
            self.assertEqual(bench.ask("/api/plan/start"), (200, ""))
            self.assertTrue(bench.reaches("done"), bench.supervisor.output())
            self.assertEqual(bench.outlook()["what_if"]["state"], "planning")
            self.assertEqual(bench.ask("/api/plan/what-if/cancel", id="other"), (409, "X0008"))
            self.assertEqual(bench.ask("/api/plan/what-if/cancel", id="long"), (200, ""))
            self.assertEqual(eventually(lambda: bench.answer("long"))["state"], "cancelled")
            self.assertEqual(bench.ask("/api/plan/what-if", goal=FEWER, id="next"), (200, ""))
            self.assertEqual(eventually(lambda: bench.answer("next"))["state"], "planned")


if __name__ == "__main__":
    unittest.main()
