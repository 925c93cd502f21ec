"""`stepwright modbus-server` beside a real runtime: values both ways, crowds, losses."""

import csv
import io
import json
import pathlib
import re
import socket
import struct
import time
import unittest

from given_time import GivenTime
from modbus_wire import Client, Refused, frame, read_request, write_request
from namespaces import ip, need_network_of_its_own
from processes import PATIENCE_S, Cell, eventually, figures_of, get, stepwright

PROGRAM = """
TYPE Pair : STRUCT first : INT; second : INT; END_STRUCT; END_TYPE
PROGRAM Main
  VAR
    count AT %MW0 : INT;
    wish AT %MW1 : INT;
    copy AT %MW2 : INT;
    level AT %MD5 : REAL; {unit := 'l', group := 'buffer', range := 0..200} // how full | it is
    lamp AT %QX0.1 : BOOL;
    torn : DINT;
    pair AT %MW20 : ARRAY[0..99] OF INT;
    i : INT;
    levels : ARRAY[0..9] OF REAL;
    soak : TIME; {range := 0..60}
    words : STRING := 'a$1B[31mred$N  Main.fake = TRUE';
  END_VAR
  count := count + 1;
  copy := wish;
  level := INT_TO_REAL(wish) / 2.0;
  FOR i := 0 TO 99 DO
    IF pair[i] <> pair[0] THEN torn := torn + 1; END_IF;
  END_FOR;
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Cpu ON Any
    TASK Fast(INTERVAL := T#5ms, PRIORITY := 1);
    PROGRAM Main WITH Fast : Main;
  END_RESOURCE
END_CONFIGURATION
"""
CONFIG = """
[clock]
mode = "real"
[plant]
kind = "none"
[modbus.server]
enabled = true
bind = "0.0.0.0"
allow = ["127.0.0.0/8", "10.9.0.0/24"]
port = 0
writable = true
max_connections = 3200
max_per_address = 3200
"""
WRITER = '[[modbus.server.client]]\naddress = "127.0.0.1"\nread = ["all"]\nwrite = ["all"]\n'
WATCHER = '[[modbus.server.client]]\naddress = "127.0.0.9"\nread = ["holding 1024-1026"]\n'
COUNT, WISH, COPY = 1024, 1025, 1026
LEVEL = 2058
PAIR = 1044


class ModbusServer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        need_network_of_its_own()

    def cell(self, more=WRITER + WATCHER, config=CONFIG):
        cell = Cell(config + more)
        self.addCleanup(cell.__exit__)
        (cell.folder / "main.st").write_text(PROGRAM, encoding="utf-8")
        self.good("compile", cell.folder / "main.st", "-o", cell.folder / "main.swb")
        return cell

    def good(self, *arguments):
        done = stepwright(*arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def run_program(self, cell):
        self.good("download", "--config", cell.config, cell.folder / "main.swb", "--replace")
        self.good("start", "--config", cell.config, "--cold")

    def serve(self, cell, program=True):
        """The processes; the port."""
        runtime = cell.start_runtime()
        if program:
            self.run_program(cell)
        server = cell.start("modbus-server")
        port = int(server.wait_for(r"listens on tcp [\d.]+:(\d+)").group(1))
        if program:
            server.wait_for("serves the program")
            self.assertTrue(eventually(lambda: self.answers(port)))
        return runtime, server, port

    def answers(self, port):
        try:
            with Client(port) as client:
                return client.read(COUNT) is not None
        except Refused:
            return False

    def test_values_go_both_ways(self):
        cell = self.cell()
        _, _, port = self.serve(cell)
        with Client(port) as client:
            first = client.read(COUNT)[0]
            self.assertTrue(eventually(lambda: client.read(COUNT)[0] != first), "the program does not scan")
            for value in range(1, 40):
                client.write(WISH, value)
                self.assertEqual(client.read(WISH)[0], value, "a write is answered when it can be read")
                self.assertTrue(eventually(lambda wanted=value: client.read(COPY)[0] == wanted))
            high, low = client.read(LEVEL, 2)
            self.assertEqual(struct.unpack(">f", struct.pack(">HH", high, low))[0], 19.5)
            client.ask(struct.pack(">BHH", 5, 1, 0xFF00))
            self.assertEqual(client.read_bits(0, 4), [0, 1, 0, 0])
            for code, pdu in ((2, read_request(8192, 1)), (3, read_request(0, 126)), (1, b"\x07"),
                              (2, write_request(8000, 1)), (3, write_request(WISH, 1)[:-1])):
                with self.assertRaises(Refused) as refused:
                    client.ask(pdu)
                self.assertEqual(refused.exception.args[0], code, pdu.hex())

    def test_a_request_is_one_write_between_two_scans(self):
        cell = self.cell()
        _, _, port = self.serve(cell)
        with Client(port) as client:
            for value in range(300):
                client.write(PAIR, *[value] * 100)
            self.assertEqual(client.read(PAIR, 100), [299] * 100)
        words = self.good("watch", "--config", cell.config, "Main.words", "--count", "1")
        self.assertIn("Main.words = a$1B[31mred$N  Main.fake = TRUE\n", words, "a text is one line, and acts on no terminal")
        torn = self.good("watch", "--config", cell.config, "Main.torn", "--count", "1")
        self.assertRegex(torn, r"Main\.torn\D+0\b", "the program saw half a request")

    def test_windows_hold(self):
        cell = self.cell()
        _, _, port = self.serve(cell)
        with Client(port, source="127.0.0.9") as watcher:
            self.assertEqual(len(watcher.read(COUNT, 3)), 3)
            for pdu in (read_request(COUNT, 4), read_request(0, 1, 1), write_request(WISH, 5)):
                with self.assertRaises(Refused) as refused:
                    watcher.ask(pdu)
                self.assertEqual(refused.exception.args[0], 2)
        with Client(port, source="127.0.0.5") as stranger, self.assertRaises(Refused):
            stranger.read(COUNT)

    def test_writing_needs_both_words(self):
        for config, more in ((CONFIG.replace("writable = true", ""), WRITER), (CONFIG, "")):
            with self.subTest(more=more):
                cell = self.cell(more, config)
                _, _, port = self.serve(cell)
                with Client(port) as client:
                    before = client.read(WISH)
                    with self.assertRaises(Refused) as refused:
                        client.write(WISH, 1234)
                    self.assertEqual(refused.exception.args[0], 2)
                    self.assertEqual(client.read(WISH), before)

    def test_a_crowd_costs_the_others_nothing_but_time(self):
        cell = self.cell()
        _, server, port = self.serve(cell)
        idle = [Client(port) for _ in range(1000)]
        halves = [Client(port) for _ in range(1000)]
        for number, client in enumerate(halves):
            client.socket.sendall(frame(read_request(COUNT, 1))[:1 + number % 11])
        slow = Client(port)
        slow.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        slow.socket.setblocking(False)
        flood = b"".join(frame(read_request(0, 125)) for _ in range(300))
        worst = worst_given = 0.0
        with Client(port) as good, GivenTime() as given:
            for _ in range(500):
                try:
                    slow.socket.send(flood)
                except (BlockingIOError, ConnectionError):
                    pass
                begin, begin_given = time.monotonic(), given.seconds()
                good.read(COUNT, 10)
                worst = max(worst, time.monotonic() - begin)
                worst_given = max(worst_given, given.seconds() - begin_given)
            merged = b"".join(frame(read_request(COUNT, 1), number) for number in range(1, 101))
            good.socket.sendall(merged)
            for number in range(1, 101):
                good.answer(number)
        self.assertLess(worst_given, 1.0)
        for number, client in enumerate(halves[:50]):
            client.socket.sendall(frame(read_request(COUNT, 1))[1 + number % 11:])
            client.answer(1)
        self.assertEqual(len(idle[500].read(COUNT)), 1)
        status = (pathlib.Path("/proc") / str(server.pid) / "status").read_text(encoding="ascii")
        memory_mb = int(re.search(r"VmRSS:\s+(\d+)", status).group(1)) / 1024
        self.assertLess(memory_mb, 60)
        print(f"2001 connections: {memory_mb:.1f} MB, slowest of 500 reads {worst * 1e3:.2f} ms")
        for client in (*idle, *halves, slow):
            client.close()

    def test_connections_that_were_cut_are_noticed(self):
        cell = self.cell(WRITER, CONFIG + "keep_alive_s = 1\n")
        ip("addr", "add", "10.9.0.1/32", "dev", "lo")
        ip("addr", "add", "10.9.0.2/32", "dev", "lo")
        self.addCleanup(ip, "addr", "del", "10.9.0.1/32", "dev", "lo")
        _, server, port = self.serve(cell)
        cut = [Client(port, "10.9.0.1", "10.9.0.2") for _ in range(1000)]

        def descriptors():
            return len(list((pathlib.Path("/proc") / str(server.pid) / "fd").iterdir()))

        self.assertTrue(eventually(lambda: descriptors() > 1000))
        ip("addr", "del", "10.9.0.2/32", "dev", "lo")
        begin = time.monotonic()
        with Client(port) as good:
            self.assertTrue(eventually(lambda: good.read(COUNT) and descriptors() < 50, pause_s=0.05))
        print(f"1000 connections that were cut are gone after {time.monotonic() - begin:.1f} s")
        for client in cut:
            client.close()

    def test_without_a_runtime_everything_is_exception_4(self):
        cell = self.cell()
        runtime, _, port = self.serve(cell)
        with Client(port) as client:
            client.read(COUNT)
            runtime.process.kill()
            begin = time.monotonic()

            def refused():
                try:
                    client.read(COUNT)
                except Refused as problem:
                    return problem.args[0]
                return None

            self.assertEqual(eventually(refused), 4)
            print(f"exception 4 {time.monotonic() - begin:.3f} s after the kill")
            with self.assertRaises(Refused) as problem:
                client.write(WISH, 1)
            self.assertEqual(problem.exception.args[0], 4)
            cell.start_runtime()
            self.assertEqual(refused(), 4)
            self.run_program(cell)
            self.assertTrue(eventually(lambda: refused() is None))
            client.write(WISH, 77)
            self.assertTrue(eventually(lambda: client.read(COPY) == [77]))

    def test_a_runtime_that_hangs_gives_no_old_values(self):
        cell = self.cell(WRITER, CONFIG + "stale_after_ms = 400\n")
        runtime, _, port = self.serve(cell)
        with Client(port) as client:
            client.read(COUNT)
            runtime.send(19)  # SIGSTOP
            self.addCleanup(runtime.send, 18)
            time.sleep(1.0)
            with self.assertRaises(Refused) as problem:
                client.read(COUNT)
            self.assertEqual(problem.exception.args[0], 4)
            runtime.send(18)
            self.assertTrue(eventually(lambda: self.answers(port)))

    def test_its_figures_are_served_over_http(self):
        cell = self.cell(more=WRITER + WATCHER + "[modbus.server.metrics]\nport = 0\n")
        runtime, server, port = self.serve(cell)
        fetch = figures_of(server)
        own = ("cell", cell.name)

        def figure(name, *labels):
            return fetch().get((f"stepwright_modbus_server_{name}", (own, *labels)))

        time.sleep(0.5)  # figures are those of a moment ago
        before = {name: figure(name) for name in ("requests_total", "writes_total", "turned_away_total", "malformed_total")}
        two = figure("exceptions_total", ("exception", "2"))
        with Client(port) as client:
            for value in range(20):
                client.write(WISH, value)
                client.read(WISH)
            with self.assertRaises(Refused):
                client.ask(read_request(8192, 1))
            self.assertTrue(eventually(lambda: figure("requests_total") == before["requests_total"] + 41))
            self.assertEqual(figure("writes_total"), before["writes_total"] + 20)
            self.assertEqual(figure("exceptions_total", ("exception", "2")), two + 1)
            self.assertEqual(figure("connections"), 1)
            self.assertEqual(figure("serving"), 1)
            p50, p999 = (figure("service_seconds", ("quantile", each)) for each in ("0.5", "0.999"))
            self.assertTrue(0 < p50 <= p999 <= figure("service_max_seconds") * (1 + 1 / 32), (p50, p999))
            client.socket.sendall(b"\0\1\0\7\0\6\1\3\0\0\0\1")  # another protocol than Modbus
            self.assertTrue(eventually(lambda: figure("malformed_total") == before["malformed_total"] + 1))
        ip("addr", "add", "10.8.0.1/32", "dev", "lo")  # which is not allowed in
        self.addCleanup(ip, "addr", "del", "10.8.0.1/32", "dev", "lo")
        stranger = socket.create_connection(("127.0.0.1", port), source_address=("10.8.0.1", 0), timeout=PATIENCE_S)
        self.assertEqual(stranger.recv(1), b"")
        stranger.close()
        self.assertTrue(eventually(lambda: figure("turned_away_total") == before["turned_away_total"] + 1))
        self.assertTrue(eventually(lambda: figure("connections") == 0))
        self.assertEqual([get(fetch.port, path)[0].status for path in ("/", "/live", "/metrics?x")], [404, 404, 200])
        self.assertEqual(get(fetch.port, host="evil.example")[0].status, 403)
        runtime.process.kill()
        self.assertTrue(eventually(lambda: figure("serving") == 0))
        self.assertEqual(server.end(), 0)

    def test_a_port_for_figures_that_is_taken_is_refused(self):
        cell = self.cell("[modbus.server.metrics]\nport = 0\n")
        _, server, _ = self.serve(cell, program=False)
        taken = figures_of(server).port
        other = self.cell(f"[modbus.server.metrics]\nport = {taken}\n")
        refused = other.start("modbus-server")
        self.assertEqual(refused.wait(), 1)
        self.assertRegex(refused.output(), r"cell\.toml:\d+:\d+: H0001: ")
        self.assertIn("modbus.server.metrics.port", refused.output())

    def test_it_is_off_unless_it_is_wanted(self):
        cell = self.cell("", '[plant]\nkind = "none"\n')
        done = stepwright("modbus-server", "--config", cell.config)
        self.assertEqual(done.returncode, 1)
        self.assertIn("C0508", done.stderr)

    def test_mistakes_have_their_place(self):
        wrong = """
[modbus.server]
allow = ["10.0.0.0/40"]
[[modbus.server.range]]
table = "holding"
first = 3
[[modbus.server.client]]
address = "10.0.0.1"
write = ["input 3", "holdin"]
"""
        cell = self.cell("", '[plant]\nkind = "none"\n' + wrong)
        done = stepwright("check", "--config", cell.config)
        self.assertEqual(done.returncode, 1)
        for code in ("C0506", "C0507", "C0508"):
            self.assertRegex(done.stderr, rf"cell\.toml:\d+:\d+: {code}: ")
        self.assertEqual(done.stderr.count("C0507"), 2)

    def test_the_register_map_is_a_document(self):
        ranges = ('[[modbus.server.range]]\ntable = "holding"\nfirst = 5000\nvariable = "Main.levels"\n'
                  '[[modbus.server.range]]\ntable = "holding"\nfirst = 6000\nvariable = "Main.level"\n'
                  '[[modbus.server.range]]\ntable = "holding"\nfirst = 7000\nvariable = "Main.soak"\n'
                  '[tags."Main.levels"]\nunit = "m"\ndescription = "of each tank"\n')
        cell = self.cell(ranges)
        rows = list(csv.DictReader(io.StringIO(self.good("registers", cell.folder / "main.swb", "--config", cell.config,
                                                         "--format", "csv"))))
        self.assertEqual([row["address"] for row in rows if row["name"] == "Main.levels[9]"], ["5018"])
        words = {row["name"]: (row["unit"], row["description"], row["group"], row["least"], row["greatest"]) for row in rows}
        self.assertEqual(words["Main.levels[9]"], ("m", "of each tank", "", "", ""))
        self.assertEqual(words["Main.level"], ("l", "how full | it is", "buffer", "0", "200"))
        table = self.good("registers", cell.folder / "main.swb", "--config", cell.config)
        self.assertIn("| 5018-5019 | 3 | Main.levels[9] | REAL |", table)
        self.assertIn("| l | how full \\| it is (buffer; 0 to 200) |", table)
        self.assertRegex(table, r"Main\.soak \| TIME \|.*\(0 s to 60 s\)", "its registers count nanoseconds")
        self.assertEqual(words["Main.soak"], ("", "", "", "0 s", "60 s"))
        listed = json.loads(self.good("registers", cell.folder / "main.swb", "--config", cell.config, "--format", "json"))
        level = next(each for each in listed if each["name"] == "Main.level")
        self.assertEqual((level["unit"], level["group"], level["normal"]), ("l", "buffer", [0, 200]))
        self.assertNotIn("normal_unit", level)
        soak = next(each for each in listed if each["name"] == "Main.soak")
        self.assertEqual((soak["normal"], soak["normal_unit"]), ([0, 60], "s"))
        cell.write(CONFIG + ranges.replace("levels", "levles"))
        done = stepwright("registers", cell.folder / "main.swb", "--config", cell.config)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"cell\.toml:\d+:\d+: C0501: .*levles")
        self.assertIn("did you mean", done.stderr)


if __name__ == "__main__":
    unittest.main()
