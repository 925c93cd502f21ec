#!/usr/bin/env python3
"""The fleet's cells with all their real processes, as fast as the machine allows. The judge is the plant: exact outlines
along the motion, and who ran into what."""

import json
import os
import pathlib
import shutil
import signal
import tempfile
import unittest

from cell_process import Demo, stepwright

CELL = pathlib.Path(__file__).parent
SMALL = CELL / "small_hall.toml"
FACE_TO_FACE = CELL / "face_to_face.toml"
# The other cells' report without what only their plants have, and the fleet's own.
KEYS = """goal_reached plan_steps plan_cost plan_proved_optimal first_plan_ms optimal_plan_ms replans makespan_s scans
overruns scan_p50_us scan_p99_us realtime_factor trace_hash processes plant fleet""".split()


class FleetJob(unittest.TestCase):
    def run_demo(self, *arguments, cell=SMALL):
        with Demo("--fast", *arguments, cell=cell) as demo:
            return demo.result()

    def check_clean(self, report):
        for name in ("overlaps", "obstacle_overlaps", "contacts"):
            self.assertEqual(report["plant"][name], 0, name)

    def test_everything_is_delivered_and_the_same_seed_gives_the_same_trace(self):
        report, code = self.run_demo(cell="fleet")
        self.assertEqual(code, 0, report["stdout"])
        for key in KEYS:
            self.assertIn(key, report)
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 0)
        self.assertEqual(report["processes"], ["runtime", "link", "supervisor"])
        self.assertEqual(report["fleet"]["delivered"], 8)
        self.check_clean(report)
        self.assertGreater(report["fleet"]["smallest_gap_m"], 0)
        document = report["record"]["fleet"]
        self.assertEqual(document["revision"], 1)
        self.assertEqual([v["state"] for v in document["vehicles"]], ["resting"] * 6)
        self.assertEqual({g["state"] for g in document["goals"]}, {"delivered"})
        self.assertGreater(len(document["precedences"]), 0)
        self.assertGreater(len(document["sections"]), 0)
        self.assertLess(len(json.dumps(document, separators=(",", ":"))), 300_000)
        # Who is driven as planned is where the schedule says, within the noise of driving.
        self.assertLess(abs(report["makespan_s"] - report["planned_makespan_s"]), 0.1 * report["planned_makespan_s"])

    def test_the_same_seed_gives_the_same_trace_and_another_one_another(self):
        hashes = [self.run_demo("--seed", seed)[0]["trace_hash"] for seed in (4, 4, 5)]
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], hashes[2])

    def test_the_others_do_the_work_of_a_dead_vehicle(self):
        report, code = self.run_demo("--fault", "dead_v2=1@5")
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 1)
        incident = report["record"]["incidents"][0]
        self.assertEqual((incident["action"], incident["decision"]), ("truck 2", "replan"))
        self.assertEqual(report["fleet"]["vehicles"][1]["state"], "lost")
        self.check_clean(report)

    def test_a_blocked_place_is_driven_around(self):
        report, code = self.run_demo("--fault", "block_1=1@30", cell="fleet")
        self.assertEqual(code, 0, report["stdout"])
        told = [i for i in report["record"]["incidents"] if "block_1 is blocked" in i["evidence"][0]]
        self.assertEqual([i["decision"] for i in told], ["replan"])
        self.check_clean(report)

    def test_what_a_blocked_place_keeps_from_being_done_is_named(self):
        report, code = self.run_demo("--fault", "block_1=1@5")  # where a vehicle has to stand at shelf 1
        self.assertEqual(code, 5, report["stdout"])
        self.assertIn("1 of 1 of 'crate' are not delivered: no vehicle finds a way", report["message"])
        self.assertEqual([g["state"] for g in report["fleet"]["goals"]], ["given_up", "delivered"])
        self.check_clean(report)

    def test_what_was_given_up_is_done_when_the_place_is_free_again(self):
        report, code = self.run_demo("--fault", "block_1=1@5", "--fault", "block_1=0@20")
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["replans"], 2)
        self.check_clean(report)

    def test_two_who_stand_face_to_face_in_an_aisle_give_way_and_get_where_they_want(self):
        report, code = self.run_demo(cell=FACE_TO_FACE)
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        actions = [action["text"] for action in report["record"]["episodes"][0]["actions"]]
        self.assertEqual(len([text for text in actions if "give_way at (" in text]), 1, actions)
        self.assertEqual(report["replans"], 0)
        self.assertEqual(report["fleet"]["delivered"], 1)
        self.assertEqual([v["state"] for v in report["fleet"]["vehicles"]], ["resting"] * 2)
        self.check_clean(report)
        self.assertGreater(report["fleet"]["smallest_gap_m"], 0)

    def test_what_is_ordered_meanwhile_is_delivered(self):
        order = '{at_s=20, name="box", from="dock B", to="shelf 2"}'
        report, code = self.run_demo("--set", f"fleet.orders=[{order}]")
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["record"]["incidents"][0]["kind"], "new_goal")
        self.assertEqual([g["state"] for g in report["fleet"]["goals"]], ["delivered"] * 3)
        self.check_clean(report)

    def test_an_emergency_stop_that_nobody_resumes_ends_the_run_safely(self):
        report, code = self.run_demo("--fault", "press_estop=1@5", "--set", "fleet.hold_s=20")
        self.assertEqual(code, 5, report["stdout"])
        self.assertFalse(report["goal_reached"])
        self.assertIn("emergency stop", report["message"])
        self.check_clean(report)

    def test_after_an_emergency_stop_the_fleet_goes_on(self):
        report, code = self.run_demo("--fault", "press_estop=1@30", "--fault", "press_estop=0@40",
                                     "--set", 'fleet.requests=[{at_s=50, request="resume"}]', cell="fleet")
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 1)
        self.assertEqual([v["state"] for v in report["fleet"]["vehicles"]], ["resting"] * 6)
        self.check_clean(report)

    def test_a_vehicle_that_died_returns(self):
        report, code = self.run_demo("--fault", "dead_v2=1@12", "--fault", "dead_v2=0@20",
                                     "--set", 'fleet.requests=[{at_s=25, request="return", vehicle="truck 2"}]')
        self.assertEqual(code, 0, report["stdout"])
        self.assertTrue(report["goal_reached"])
        self.assertEqual(report["replans"], 2)
        self.assertEqual([v["state"] for v in report["fleet"]["vehicles"]], ["resting"] * 3)
        self.check_clean(report)

    def test_a_supervisor_that_is_killed_goes_on_with_the_missions(self):
        with Demo("--set", "clock.speed=40", cell=SMALL) as demo:
            demo.wait_for_line("supervisor", "executing: driving plan 1")
            os.kill(demo.pid_of("supervisor"), signal.SIGKILL)
            report, code = demo.result()
        self.assertEqual(code, 0, report["stdout"])
        self.assertEqual(report["restarts"], {"supervisor": 1})
        self.assertEqual(report["replans"], 0)
        evidence = [i["evidence"][0] for i in report["record"]["incidents"]]
        self.assertIn("the supervisor was restarted; the missions have gone on", evidence)
        self.check_clean(report)


class WrongInput(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        for name in ("small_hall.toml", "small_hall.json", "map.yaml", "map.pgm", "hall.yaml", "hall.pgm"):
            shutil.copy(CELL / name, self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def change(self, name, old, new):
        file = self.folder / name
        text = file.read_text(encoding="utf-8")
        self.assertIn(old, text)
        file.write_text(text.replace(old, new, 1), encoding="utf-8")

    def refused(self, *patterns, sets=()):
        more = [word for text in sets for word in ("--set", text)]
        done = stepwright("check", "--config", self.folder / "small_hall.toml", *more)
        self.assertEqual(done.returncode, 1, done.stdout)
        for pattern in patterns:
            self.assertRegex(done.stderr, pattern)
        return done.stderr

    def test_the_cells_of_this_tree_are_sound(self):
        for name in ("cell.toml", "small_hall.toml"):
            done = stepwright("check", "--config", CELL / name)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_problem_is_missing(self):
        self.change("small_hall.toml", '"small_hall.json"', '"nowhere.json"')
        self.refused(r"small_hall\.toml:\d+:\d+: C0006: .*nowhere\.json")

    def test_the_problem_is_on_another_floor(self):
        self.change("small_hall.json", '"map.yaml"', '"hall.yaml"')
        text = self.refused("F07|C0543")
        self.assertTrue(text)

    def test_the_map_differs(self):
        self.change("small_hall.toml", 'map = "map.yaml"', "")
        shutil.copy(self.folder / "map.yaml", self.folder / "other.yaml")
        image = bytearray((self.folder / "map.pgm").read_bytes())
        image[len(image) - 180 * 120 + 180 * 10 + 90] = 0  # one cell of the 180 x 120, where nobody stands
        (self.folder / "other.pgm").write_bytes(image)
        self.change("other.yaml", "map.pgm", "other.pgm")
        self.change("small_hall.toml", "seed = 1 ", 'map = "other.yaml"\nseed = 1 ')
        self.refused(r"small_hall\.toml:\d+:\d+: C0543: the map of the problem is not that of the plant")

    def test_a_vehicle_stands_elsewhere(self):
        self.change("small_hall.toml", "x_m = 32.0", "x_m = 31.0")
        self.refused(r"small_hall\.toml:\d+:\d+: C0544: v2 stands at \(31")

    def test_a_vehicle_is_missing(self):
        self.change("small_hall.json", ',\n  {"name": "truck 3", "start": {"x_m": 4, "y_m": 12, "heading_deg": 0}}', "")
        self.change("small_hall.json", ',\n  {"vehicle": "truck 3", "to": {"x_m": 4, "y_m": 12, "heading_deg": 0}}', "")
        self.refused("C0542: the plant has 3 vehicles, the problem 2")

    def test_a_terminal_is_missing(self):
        self.refused("C0541: the terminal lift_v3 has no address", sets=['plant.ports.x_v1="%IW0"'])

    def test_an_order_names_no_location(self):
        self.refused("X0003: there is no location 'attic'",
                     sets=['fleet.orders=[{at_s=1, name="box", from="attic", to="dock A"}]'])

    def test_a_request_names_no_vehicle_or_is_none(self):
        self.refused("X0003: there is no vehicle 'truck 9'",
                     sets=['fleet.requests=[{at_s=1, request="return", vehicle="truck 9"}]'])
        self.refused("nobody can ask for 'dance'", sets=['fleet.requests=[{at_s=1, request="dance"}]'])
        self.refused("a vehicle can return, and only the fleet can hold or resume",
                     sets=['fleet.requests=[{at_s=1, request="return"}]'])

    def test_two_missions_are_one_too_many(self):
        self.refused("C0545: the cell has .planning. and .fleet.", sets=['planning.domain="map.yaml"'])


class Program(unittest.TestCase):
    def test_a_problem_becomes_a_program_that_the_cell_takes(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
        try:
            image = folder / "fleet.swb"
            done = stepwright("fleet", CELL / "small_hall.json", "--program", image, "--config", SMALL)
            self.assertEqual(done.returncode, 0, done.stderr)
            checked = stepwright("check", "--config", SMALL, "--program", image)
            self.assertEqual(checked.returncode, 0, checked.stderr)
            self.assertEqual(stepwright("fleet", CELL / "small_hall.json", "--config", SMALL).returncode, 2)
        finally:
            shutil.rmtree(folder)


if __name__ == "__main__":
    unittest.main()
