"""Modbus/TCP Security of stepwright modbus-server with OpenSSL's own client and Python's, on the certificates of the recipe
in runtime/doc/modbus_security.md, which is run as it stands there."""

import os
import pathlib
import re
import socket
import ssl
import struct
import subprocess
import time
import unittest

from namespaces import need_network_of_its_own
from processes import SOURCES, eventually
from served import Served

PORT = 1802
CLIENT_EXTENSIONS = "extendedKeyUsage = clientAuth\n"
ROLE = "1.3.6.1.4.1.50316.802.1 = ASN1:UTF8String:"
ACCESS = f"""
plain = false
greeting_timeout_ms = 1000
[modbus.server.tls]
port = {PORT}
certificate = "tls/plc.crt"
key = "tls/plc.key"
authorities = "tls/plant-ca.crt"
[[modbus.server.client]]
role = "operator"
read = ["all"]
write = ["holding 0-9"]
[[modbus.server.client]]
role = "viewer"
read = ["holding 0-9"]
"""


def recipe():
    text = (SOURCES / "runtime/doc/modbus_security.md").read_text(encoding="utf-8")
    return re.search(r"```sh\n(.*?)```", text, re.S).group(1)


class Tls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        need_network_of_its_own()
        cls.cell = Served(ACCESS)
        cls.addClassCleanup(cls.cell.__exit__)
        cls.folder = cls.cell.folder / "tls"
        cls.folder.mkdir()
        cls.shell(recipe())
        cls.certify("viewer", CLIENT_EXTENSIONS + ROLE + "viewer\n")
        cls.certify("nobody", CLIENT_EXTENSIONS)
        cls.certify("expired", CLIENT_EXTENSIONS + ROLE + "operator\n", days=-1)
        cls.shell("openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 30 -keyout other-ca.key "
                  "-out other-ca.crt -subj /CN=other")
        cls.certify("stranger", CLIENT_EXTENSIONS + ROLE + "operator\n", authority="other-ca")
        _, cls.server = cls.cell.start_all()
        assert eventually(lambda: cls.ask("operator", 3, 0, 1)[0] == 3, 20), cls.server.output()

    @classmethod
    def shell(cls, script):
        done = subprocess.run(["sh", "-ec", script], cwd=cls.folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr

    @classmethod
    def certify(cls, name, extensions, authority="plant-ca", days=30):
        (cls.folder / f"{name}.ext").write_text(extensions, encoding="ascii")
        cls.shell(f"openssl req -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -keyout {name}.key -out {name}.csr "
                  f"-subj /CN={name}; openssl x509 -req -in {name}.csr -CA {authority}.crt -CAkey {authority}.key "
                  f"-CAcreateserial -days {days} -extfile {name}.ext -out {name}.crt")

    @classmethod
    def connect(cls, name, version=None):
        context = ssl.create_default_context(cafile=cls.folder / "plant-ca.crt")
        if version:
            context.maximum_version = version
        if name:
            context.load_cert_chain(cls.folder / f"{name}.crt", cls.folder / f"{name}.key")
        return context.wrap_socket(socket.create_connection(("127.0.0.1", PORT), timeout=5), server_hostname="localhost")

    @classmethod
    def ask(cls, name, function, address, value, version=None):
        """The answer's PDU."""
        with cls.connect(name, version) as connection:
            connection.sendall(struct.pack(">HHHBBHH", 7, 0, 6, 1, function, address, value))
            answer = connection.recv(300)
            return answer[7:]

    def s_client(self, *arguments, text=""):
        return subprocess.run(["openssl", "s_client", "-connect", f"127.0.0.1:{PORT}", "-CAfile", "plant-ca.crt",
                               "-verify_return_error", *arguments], input=text, cwd=self.folder, capture_output=True,
                              text=True, timeout=30, check=False)

    def refused(self, name, reason):
        """The server ends the connection, and says why in its log. (In TLS 1.3 a client learns it with its first read.)"""
        logged = len(self.server.output())
        with self.assertRaises((ssl.SSLError, ConnectionError, AssertionError)):
            self.assertTrue(self.ask(name, 3, 0, 1), "closed")
        self.assertTrue(eventually(lambda: reason in self.server.output()[logged:], 10), self.server.output()[logged:])

    def test_roles(self):
        self.assertEqual(self.ask("operator", 6, 3, 0x1234), bytes([6, 0, 3, 0x12, 0x34]))
        self.assertEqual(self.ask("operator", 3, 3, 1), bytes([3, 2, 0x12, 0x34]))
        self.assertEqual(self.ask("viewer", 3, 3, 1), bytes([3, 2, 0x12, 0x34]))
        # What a role may not is exception 1, and nothing is written.
        self.assertEqual(self.ask("viewer", 6, 3, 0x4321), bytes([0x86, 1]))
        self.assertEqual(self.ask("viewer", 3, 20, 1), bytes([0x83, 1]))
        self.assertEqual(self.ask("operator", 6, 10, 1), bytes([0x86, 1]))
        self.assertEqual(self.ask("nobody", 3, 3, 1), bytes([0x83, 1]))
        self.assertEqual(self.ask("operator", 3, 3, 1), bytes([3, 2, 0x12, 0x34]))

    def test_versions(self):
        self.assertEqual(self.ask("operator", 3, 0, 1, ssl.TLSVersion.TLSv1_2)[0], 3)
        self.assertEqual(self.ask("operator", 3, 0, 1, ssl.TLSVersion.TLSv1_3)[0], 3)
        done = self.s_client("-tls1_1", "-cipher", "DEFAULT@SECLEVEL=0", "-cert", "operator.crt", "-key", "operator.key")
        self.assertNotEqual(done.returncode, 0)

    def test_certificates_that_are_none(self):
        self.refused("", "peer did not return a certificate")
        self.refused("expired", "certificate has expired")
        self.refused("stranger", "unable to get local issuer certificate")
        self.assertEqual(self.ask("operator", 3, 0, 1)[0], 3)

    def test_openssl_client(self):
        good = self.s_client("-cert", "operator.crt", "-key", "operator.key", text="Q\n")
        self.assertEqual(good.returncode, 0, good.stderr)
        self.assertIn("Verify return code: 0 (ok)", good.stdout)
        # `R` asks for a renegotiation.
        again = self.s_client("-tls1_2", "-cert", "operator.crt", "-key", "operator.key", text="R\n")
        self.assertIn("no renegotiation", again.stderr)
        self.assertEqual(self.ask("operator", 3, 0, 1)[0], 3)

    def test_many_requests_in_one_record(self):
        """More than the server's buffer holds, behind a write that waits for the scan."""
        with self.connect("operator") as connection:
            write = struct.pack(">HHHBBHH", 0, 0, 6, 1, 6, 5, 77)
            reads = [struct.pack(">HHHBBHH", number, 0, 6, 1, 3, 5, 1) for number in range(1, 400)]
            connection.sendall(b"".join([write, *reads]))
            expected = write + b"".join(read[:4] + struct.pack(">HBBBH", 5, 1, 3, 2, 77) for read in reads)
            got = b""
            while len(got) < len(expected):
                more = connection.recv(65536)
                self.assertTrue(more, "closed")
                got += more
            self.assertEqual(got, expected)

    def test_half_a_record(self):
        """It holds up nobody, and the server does not turn round and round over it."""
        with self.connect("operator") as connection:
            self.assertEqual(self.ask("operator", 3, 0, 1)[0], 3)
            raw = socket.socket(fileno=os.dup(connection.fileno()))
            raw.sendall(b"\x17\x03\x03\x00\x40half")
            before = self.processor_s()
            time.sleep(0.5)
            self.assertLess(self.processor_s() - before, 0.2)
            self.assertEqual(self.ask("operator", 3, 0, 1)[0], 3)
            raw.close()

    def processor_s(self):
        fields = pathlib.Path(f"/proc/{self.server.pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def test_slow_handshakes(self):
        """Whoever does not greet holds up nobody."""
        silent = [socket.create_connection(("127.0.0.1", PORT), timeout=5) for _ in range(50)]
        half = silent[0]
        half.sendall(b"\x16\x03\x01")
        for _ in range(20):
            self.assertEqual(self.ask("operator", 3, 0, 1)[0], 3)
        half.settimeout(10)
        self.assertEqual(half.recv(100), b"", "it may not stay for ever")
        for each in silent:
            each.close()

    def test_plain_modbus(self):
        with socket.create_connection(("127.0.0.1", PORT), timeout=5) as plain:
            plain.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 1, 3, 0, 1))
            try:
                self.assertNotEqual(plain.recv(300)[:2], b"\x00\x01")
            except ConnectionError:
                pass


if __name__ == "__main__":
    unittest.main()
