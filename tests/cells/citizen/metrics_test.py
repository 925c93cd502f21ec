"""The figures in the text form of Prometheus: over HTTP from the real page process, and from the socket."""

import re
import unittest

from processes import NO_PLANT, Cell, eventually, get, parse_metrics, stepwright

REAL = NO_PLANT + '[clock]\nmode = "real"\n'
FAMILIES = {"stepwright_up", "stepwright_build_info", "stepwright_state", "stepwright_scans_total",
            "stepwright_scan_overruns_total", "stepwright_scan_duration_seconds", "stepwright_scan_duration_max_seconds",
            "stepwright_traps_total", "stepwright_lost_events_total", "stepwright_service_clients",
            "stepwright_uptime_seconds", "stepwright_realtime_factor", "stepwright_resident_memory_bytes"}


class Metrics(unittest.TestCase):
    def page(self, cell):
        page = cell.start("hmi", "--port", "0")
        return int(page.wait_for(r"http://127\.0\.0\.1:(\d+)/").group(1))

    def test_the_socket_gives_every_figure_and_a_strict_reader_takes_them(self):
        with Cell(REAL) as cell:
            cell.start_runtime()
            cell.load(1_000)
            key = (("runtime", cell.name),)
            self.assertTrue(eventually(lambda: cell.figure("stepwright_scans_total") > 200))
            figures = cell.metrics()
            self.assertLessEqual(FAMILIES, {name for name, _ in figures})
            self.assertEqual(figures[("stepwright_state", (*key, ("state", "running")))], 1)
            self.assertEqual(figures[("stepwright_service_clients", key)], 1)
            self.assertGreater(figures[("stepwright_resident_memory_bytes", key)], 1e6)
            p50 = figures[("stepwright_scan_duration_seconds", (*key, ("quantile", "0.5")))]
            p99 = figures[("stepwright_scan_duration_seconds", (*key, ("quantile", "0.99")))]
            self.assertGreater(p50, 0)
            self.assertLessEqual(p50, p99)
            self.assertLessEqual(p99, figures[("stepwright_scan_duration_max_seconds", key)] * (1 + 1 / 32))

    def test_a_runtime_that_is_not_there_is_a_figure_too(self):
        with Cell(REAL) as cell:
            done = stepwright("metrics", "--config", cell.config)
            self.assertEqual(done.returncode, 5)
            self.assertEqual(parse_metrics(done.stdout), {("stepwright_up", (("runtime", cell.name),)): 0})

    def test_a_file_for_the_collector_is_whole(self):
        with Cell(REAL) as cell:
            cell.start_runtime()
            out = cell.folder / "stepwright.prom"
            self.assertEqual(stepwright("metrics", "--config", cell.config, "--out", out).returncode, 0)
            self.assertIn(("stepwright_up", (("runtime", cell.name),)), parse_metrics(out.read_text(encoding="utf-8")))

    def test_the_page_process_serves_them_over_http(self):
        with Cell(REAL, domain=91) as cell:
            port = self.page(cell)
            answer, text = get(port)
            self.assertEqual(answer.status, 200)
            self.assertEqual(parse_metrics(text), {("stepwright_up", (("runtime", cell.name),)): 0})
            cell.start_runtime()
            cell.start("link")
            cell.load(1_000)
            key = (("runtime", cell.name),)
            self.assertTrue(eventually(lambda: parse_metrics(get(port)[1]).get(("stepwright_scans_total", key), 0) > 100))
            answer, text = get(port)
            self.assertEqual(answer.headers["Content-Type"], "text/plain; version=0.0.4; charset=utf-8")
            figures = parse_metrics(text)
            self.assertLessEqual(FAMILIES, {name for name, _ in figures})
            # The same as from the socket, but for what has moved on meanwhile.
            direct = cell.metrics()
            self.assertEqual({name for name, _ in figures}, {name for name, _ in direct})
            build = [labels for name, labels in direct if name == "stepwright_build_info"]
            self.assertEqual(build, [labels for name, labels in figures if name == "stepwright_build_info"])
            self.assertTrue(re.match(r"\d+\.\d+", dict(build[0])["version"]))
            self.assertLessEqual(figures[("stepwright_scans_total", key)], direct[("stepwright_scans_total", key)])

    def test_several_runtimes_are_told_apart(self):
        one = Cell(REAL + '[hmi]\nmetrics_of = ["other-line"]\n', domain=92)
        two = Cell(REAL, domain=92, name="other-line")
        with one, two:
            for cell in (one, two):
                cell.start_runtime()
                cell.start("link")
                cell.load(1_000)
            port = self.page(one)
            wanted = {("stepwright_up", (("runtime", cell.name),)): 1 for cell in (one, two)}
            self.assertTrue(eventually(lambda: wanted.items() <= parse_metrics(get(port)[1]).items()), get(port)[1])
            two.processes[0].end()
            gone = ("stepwright_up", (("runtime", "other-line"),))
            self.assertTrue(eventually(lambda: parse_metrics(get(port)[1])[gone] == 0))
            self.assertEqual(parse_metrics(get(port)[1])[("stepwright_up", (("runtime", one.name),))], 1)

    def test_a_name_that_is_not_ours_is_not_served(self):
        with Cell(REAL, domain=91) as cell:
            port = self.page(cell)
            self.assertEqual(get(port, host="evil.example")[0].status, 403)


class Reader(unittest.TestCase):
    """The reader of these tests must be able to refuse."""

    def test_it_refuses_what_is_wrong(self):
        head = "# HELP a_total x\n# TYPE a_total counter\n"
        self.assertEqual(parse_metrics(head + 'a_total{l="v"} 1\n'), {("a_total", (("l", "v"),)): 1})
        for wrong in (head + "a_total 1", "a_total 1\n", head + "a_total 1\na_total 1\n", head + "b_total 1\n",
                      head + 'a_total{l="v} 1\n', head + "a_total one\n", head + head, head + 'a_total{l="1",l="2"} 1\n',
                      "# HELP a x\n# TYPE a counter\na 1\n", head + "a_total -1\n", head + "\n"):
            with self.assertRaises(ValueError, msg=wrong):
                parse_metrics(wrong)


if __name__ == "__main__":
    unittest.main()
