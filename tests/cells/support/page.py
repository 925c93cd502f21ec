"""The page's server under test, and a client that speaks to it as the page does."""

import http.client
import json
import re
import ssl
import subprocess

from processes import NO_PLANT, PATIENCE_S, Cell

PASSWORD = "correct horse"


def make_certificate(folder):
    """A certificate of 127.0.0.1 that signs itself, and its key."""
    certificate, key = folder / "page.pem", folder / "page.key"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                    "-keyout", key, "-out", certificate, "-days", "2", "-subj", "/CN=stepwright",
                    "-addext", "subjectAltName=IP:127.0.0.1"], check=True, capture_output=True)
    return certificate, key


class Page:
    """`stepwright hmi` of a cell, without a plant unless `more` of its configuration has one; keeps cookie and CSRF token
    like a browser."""

    def __init__(self, hmi="", tls=False, more=NO_PLANT, domain=93):
        self.cell = Cell(more, domain=domain)
        self.tls = tls
        lines = f"[hmi]\nport = 0\n{hmi}"
        if tls:
            self.certificate, _ = make_certificate(self.cell.folder)
            lines += 'tls_certificate = "page.pem"\ntls_key = "page.key"\n'
        self.cell.write(more + lines)
        self.cookie = self.csrf = ""
        self.process = None

    def __enter__(self):
        return self

    def __exit__(self, *more):
        self.cell.__exit__(*more)

    @property
    def trail(self):
        return self.cell.state / "access" / "audit.jsonl"

    def start(self):
        self.process = self.cell.start("hmi")
        found = self.process.wait_for(r"at (https?)://(\S+):(\d+)/")
        self.scheme, self.host, self.port = found.group(1), found.group(2), int(found.group(3))
        return self.process

    def setup_token(self):
        return re.search(r"set-up token ([A-Z2-9-]{24})", self.process.output()).group(1)

    def connection(self):
        if not self.tls:
            return http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        trust = ssl.create_default_context(cafile=self.certificate)
        return http.client.HTTPSConnection("127.0.0.1", self.port, timeout=PATIENCE_S, context=trust)

    def headers(self):
        return {"Origin": f"{self.scheme}://127.0.0.1:{self.port}", "Content-Type": "application/json",
                "Cookie": self.cookie, "X-CSRF-Token": self.csrf}

    def ask(self, method, path, body=None, **headers):
        """The answer with its status, headers and JSON; logs in where the answer brings a cookie."""
        connection = self.connection()
        connection.request(method, path, json.dumps(body) if body is not None else None, {**self.headers(), **headers})
        answer = connection.getresponse()
        text = answer.read().decode()
        connection.close()
        answer.json = json.loads(text) if answer.headers["Content-Type"] == "application/json" else text
        if answer.headers["Set-Cookie"]:
            self.cookie = answer.headers["Set-Cookie"].split(";")[0]
            self.csrf = answer.json.get("csrf", "")
        return answer

    def claim(self):
        answer = self.ask("POST", "/api/setup", {"token": self.setup_token(), "name": "root", "password": PASSWORD})
        assert answer.status == 200, answer.json
        return answer

    def upgrade(self, *fields):
        """The status of a WebSocket's handshake."""
        connection = self.connection()
        connection.connect()
        lines = ["GET /live HTTP/1.1", f"Host: 127.0.0.1:{self.port}", "Upgrade: websocket", "Connection: Upgrade",
                 "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==", *fields, "", ""]
        connection.sock.sendall("\r\n".join(lines).encode())
        head = connection.sock.makefile("rb").readline().decode()
        connection.close()
        return int(head.split()[1])
