"""Who may do what, over real sockets: the claim, TLS, restarts, a kill in the middle of the audit trail, tampering."""

import json
import signal
import socket
import stat
import threading
import unittest

from page import PASSWORD, Page
from processes import NO_PLANT, PATIENCE_S, eventually, stepwright


class Claim(unittest.TestCase):
    def test_nobody_gets_in_until_somebody_has_claimed_it(self):
        with Page() as page:
            page.start()
            self.assertEqual(page.ask("GET", "/").status, 200)
            self.assertEqual(page.upgrade(), 401)
            self.assertEqual(page.ask("GET", "/api/forces").status, 401)
            answer = page.claim()
            self.assertRegex(answer.headers["Set-Cookie"],
                             rf"^__Host-stepwright-{page.port}=[\w-]{{43}}; Path=/; Secure; HttpOnly; SameSite=Strict$")
            self.assertEqual(page.ask("GET", "/api/forces").status, 200)
            self.assertEqual(page.upgrade(f"Cookie: {page.cookie}"), 403)
            csrf = f"Sec-WebSocket-Protocol: csrf.{page.csrf}"
            self.assertEqual(page.upgrade(f"Cookie: {page.cookie}", csrf), 101)
            self.assertEqual(page.upgrade(f"Cookie: {page.cookie}", csrf, "Origin: http://evil.example"), 403)
            self.assertEqual(page.ask("POST", "/api/setup", {"token": "x", "name": "me", "password": PASSWORD}).status, 403)
            for file in (page.trail, page.cell.state / "access" / "users.json"):
                self.assertEqual(stat.S_IMODE(file.stat().st_mode), 0o600)

    def test_a_restart_keeps_users_and_ends_sessions(self):
        with Page() as page:
            page.start()
            first = page.setup_token()
            page.process.end(signal.SIGKILL)
            page.start()
            self.assertNotEqual(page.setup_token(), first)
            page.claim()
            page.process.end(signal.SIGKILL)
            page.start()
            self.assertNotIn("set-up token", page.process.output())
            self.assertEqual(page.ask("GET", "/api/users").status, 401)
            self.assertEqual(page.ask("POST", "/api/session", {"name": "root", "password": PASSWORD}).status, 200)
            self.assertEqual(page.ask("GET", "/api/users").status, 200)

    def test_looking_is_open_where_the_configuration_says_so(self):
        with Page('anonymous = "viewer"\n') as page:
            page.start()
            self.assertEqual(page.upgrade(), 101)
            self.assertEqual(page.ask("POST", "/api/plan/abort", {}).status, 401)

    def test_guesses_are_slowed_down(self):
        with Page() as page:
            page.start()
            page.claim()
            statuses = [page.ask("POST", "/api/session", {"name": "root", "password": "a guess"}).status for _ in range(5)]
            self.assertEqual(statuses, [401] * 5)
            locked = page.ask("POST", "/api/session", {"name": "root", "password": PASSWORD})
            self.assertEqual(locked.status, 429)
            self.assertGreater(int(locked.headers["Retry-After"]), 0)

    def test_what_is_no_request_of_the_page_is_refused(self):
        with Page() as page:
            page.start()
            page.claim()
            for headers, status in [({"Origin": "http://evil.example"}, 403), ({"Origin": ""}, 403),
                                    ({"X-CSRF-Token": "x"}, 403), ({"Content-Type": "text/plain"}, 415),
                                    ({"Host": "evil.example"}, 403)]:
                self.assertEqual(page.ask("POST", "/api/plan/abort", {}, **headers).status, status, headers)
            self.assertEqual(page.ask("POST", "/api/plan/abort", {"reason": "x" * 20_000}).status, 413)
            self.assertEqual(page.ask("PUT", "/api/plan/abort", {}).headers["Allow"], "POST")
            refused = page.ask("POST", "/api/plan/goal", {"gaol": "x"})
            self.assertEqual((refused.status, refused.json["problems"][0]["code"]), (400, "H0031"))
            nobody = page.ask("POST", "/api/plan/abort", {})
            self.assertEqual((nobody.status, nobody.json["problems"][0]["code"]), (503, "D0001"))


class OneServer(unittest.TestCase):
    def test_a_second_server_of_the_cell_is_refused_and_the_first_goes_on(self):
        with Page() as page:
            page.start()
            page.claim()
            second = stepwright("hmi", "--config", page.cell.config)
            self.assertEqual(second.returncode, 1)
            self.assertIn("H0004: another page server keeps this folder", second.stderr)
            self.assertEqual(page.ask("POST", "/api/users", {"name": "bob", "role": "viewer", "password": "bobs password"}).status, 200)
            page.process.end(signal.SIGKILL)
            page.start()
            self.assertEqual(page.ask("POST", "/api/session", {"name": "bob", "password": "bobs password"}).status, 200)

    def test_servers_of_one_host_do_not_log_each_other_out(self):
        with Page(domain=94) as one, Page(domain=95) as other:
            one.start()
            other.start()
            one.claim()
            other.claim()
            jar = {"Cookie": f"{one.cookie}; {other.cookie}"}
            for page in (one, other):
                self.assertEqual(page.ask("GET", "/api/users", **jar).status, 200)


class Records(unittest.TestCase):
    def test_a_history_that_cannot_be_kept_keeps_nobody_from_looking(self):
        with Page(more=NO_PLANT + '[history]\nfolder = "kept/history"\n') as page:
            blocked = page.cell.state / "kept"
            blocked.parent.mkdir(mode=0o700, exist_ok=True)
            blocked.write_text("not a folder", encoding="utf-8")
            page.start()
            page.process.wait_for("nothing is recorded: ")
            page.claim()
            answer = page.ask("GET", "/api/history/tags")
            self.assertEqual((answer.status, answer.json["problems"][0]["code"]), (503, "S0001"))
            self.assertEqual(page.ask("GET", "/").status, 200)
            blocked.unlink()
            eventually(lambda: page.ask("GET", "/api/history/tags").status == 200)
            page.process.wait_for("values and alarms are recorded from here on")


class Tls(unittest.TestCase):
    def test_page_and_socket_work_over_tls(self):
        with Page(tls=True) as page:
            page.start()
            self.assertEqual(page.scheme, "https")
            self.assertIn("<html", page.ask("GET", "/").json)
            page.claim()
            self.assertEqual(page.ask("GET", "/api/users").status, 200)
            csrf = f"Sec-WebSocket-Protocol: csrf.{page.csrf}"
            self.assertEqual(page.upgrade(f"Cookie: {page.cookie}", csrf, f"Origin: https://127.0.0.1:{page.port}"), 101)
            self.assertEqual(page.upgrade(f"Cookie: {page.cookie}", csrf, f"Origin: http://127.0.0.1:{page.port}"), 403)
            with socket.create_connection(("127.0.0.1", page.port), timeout=PATIENCE_S) as plain:
                plain.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
                self.assertNotIn(b"HTTP/1.1 200", plain.recv(4_096))
            self.assertEqual(page.ask("GET", "/").status, 200)

    def test_beyond_this_machine_only_with_tls_and_an_administrator(self):
        with Page('host = "0.0.0.0"\n') as page:
            done = stepwright("hmi", "--config", page.cell.config)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"cell\.toml:\d+:\d+: C0468")
            self.assertRegex(done.stderr, r"cell\.toml:\d+:\d+: C0470")
        with Page('host = "0.0.0.0"\nnames = ["line.plant"]\n', tls=True) as page:
            page.start()
            self.assertEqual(page.host, "127.0.0.1")
            page.process.wait_for("listens at this machine only")
            page.claim()
            page.process.end()
            page.start()
            self.assertEqual(page.host, "line.plant", "the name that is served, and no 0.0.0.0")
            self.assertEqual(page.ask("GET", "/", Host=f"line.plant:{page.port}").status, 200)
            self.assertEqual(page.ask("GET", "/", Host=f"0.0.0.0:{page.port}").status, 403)

    def test_a_wrong_certificate_is_told(self):
        with Page(tls=True) as page:
            (page.cell.folder / "page.key").write_text("no key", encoding="utf-8")
            done = stepwright("hmi", "--config", page.cell.config)
            self.assertEqual(done.returncode, 1)
            self.assertIn("page.key: H0003", done.stderr)


class Trail(unittest.TestCase):
    def verify(self, page):
        return stepwright("hmi", "--verify-audit", page.trail)

    def test_what_was_confirmed_survives_a_kill(self):
        with Page() as page:
            page.start()
            page.claim()
            threading.Timer(0.3, lambda: page.process.send(signal.SIGKILL)).start()
            confirmed = 0
            try:
                while page.ask("DELETE", "/api/sessions/nobody").status == 404:
                    confirmed += 1
            except OSError:
                pass
            self.assertGreater(confirmed, 0)
            self.assertTrue(eventually(lambda: not page.process.running()))
            page.start()
            done = self.verify(page)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines = [json.loads(line) for line in page.trail.read_text(encoding="utf-8").splitlines()]
            ended = [line for line in lines if line["action"] == "session.revoke" and line["result"] != "begun"]
            self.assertGreaterEqual(len(ended), confirmed)

    def test_tampering_is_found_by_the_command_and_told_at_the_next_start(self):
        with Page() as page:
            page.start()
            page.claim()
            page.ask("DELETE", "/api/sessions/nobody")
            page.process.end()
            self.assertRegex(self.verify(page).stdout, r"^3 entries, head [0-9a-f]{64}\n$")
            text = page.trail.read_text(encoding="utf-8")
            page.trail.write_text(text.replace("nobody", "nobadi", 1), encoding="utf-8")
            done = self.verify(page)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"audit\.jsonl:2:1: H0050: this line is wrong: it is not what was written")
            page.start()
            page.process.wait_for("line 2 was wrong")
            self.assertTrue((page.trail.parent / "audit.jsonl.broken-1").exists())
            self.assertEqual(self.verify(page).returncode, 0)


if __name__ == "__main__":
    unittest.main()
