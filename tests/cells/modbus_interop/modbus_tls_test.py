"""Modbus/TCP Security of stepwright modbus-server with OpenSSL's own client and Python's, on the certificates of the recipe
in runtime/doc/modbus_security.md, which is run as it stands there."""

import os
import pathlib
import re
import shutil
import signal
import socket
import ssl
import struct
import subprocess
import time
import unittest

from namespaces import need_network_of_its_own
from processes import PATIENCE_S, SOURCES, eventually, figures_of
from served import CELL, Served

PORT = 1802
CLIENT_EXTENSIONS = "extendedKeyUsage = clientAuth\n"
ROLE = "1.3.6.1.4.1.50316.802.1 = ASN1:UTF8String:"
ACCESS = f"""
plain = false
greeting_timeout_ms = 10_000
[modbus.server.tls]
port = {PORT}
certificate = "tls/plc.crt"
key = "tls/plc.key"
authorities = "tls/plant-ca.crt"
[modbus.server.metrics]
port = 0
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
        assert eventually(lambda: cls.ask("operator", 3, 0, 1)[0] == 3), cls.server.output()

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
        return context.wrap_socket(socket.create_connection(("127.0.0.1", PORT), timeout=PATIENCE_S), server_hostname="localhost")

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
                              text=True, timeout=PATIENCE_S, check=False)

    def refused(self, name, reason):
        """The server ends the connection, and says why in its log. (In TLS 1.3 a client learns it with its first read.)"""
        logged = len(self.server.output())
        with self.assertRaises((ssl.SSLError, ConnectionError, AssertionError)):
            self.assertTrue(self.ask(name, 3, 0, 1), "closed")
        self.assertTrue(eventually(lambda: reason in self.server.output()[logged:]), self.server.output()[logged:])

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
        silent = [socket.create_connection(("127.0.0.1", PORT), timeout=PATIENCE_S) for _ in range(50)]
        half = silent[0]
        half.sendall(b"\x16\x03\x01")
        for _ in range(20):
            self.assertEqual(self.ask("operator", 3, 0, 1)[0], 3)
        half.settimeout(600)
        self.assertEqual(half.recv(100), b"", "it may not stay for ever")
        for each in silent:
            each.close()

    def reload(self, says):
        """What the log says about it."""
        logged = len(self.server.output())
        self.server.send(signal.SIGHUP)
        self.assertTrue(eventually(lambda: says in self.server.output()[logged:]), self.server.output()[logged:])
        return self.server.output()[logged:]

    def serial(self, connection):
        return connection.getpeercert()["serialNumber"]

    def exchange(self, connection):
        connection.sendall(struct.pack(">HHHBBHH", 7, 0, 6, 1, 3, 0, 1))
        return connection.recv(300)[7]

    def restore(self):
        for path in (self.folder / "before").iterdir():
            shutil.copy(path, self.folder / path.name)
        self.cell.write(CELL + ACCESS)
        self.reload("the configuration was read again")

    def test_new_certificates(self):
        """A reload has new connections meet the new files; those that are there go on."""
        keep = self.folder / "before"
        keep.mkdir()
        for name in ("plc.crt", "plc.key", "plant-ca.crt"):
            shutil.copy(self.folder / name, keep)
        self.addCleanup(shutil.rmtree, keep)
        self.addCleanup(self.restore)
        self.certify("plc2", "extendedKeyUsage = serverAuth\nsubjectAltName = DNS:localhost\n", days=7)
        fetch = figures_of(self.server)
        ends = ("stepwright_modbus_server_certificate_expiry_timestamp_seconds", (("cell", self.cell.name),))
        self.assertGreater(fetch()[ends], time.time() + 800 * 86_400)
        stays = self.connect("operator")
        self.addCleanup(stays.close)
        first = self.serial(stays)

        # The same names, other contents.
        for end in ("crt", "key"):
            shutil.copy(self.folder / f"plc2.{end}", self.folder / f"plc.{end}")
        self.assertIn("nothing has changed", self.reload("the configuration was read again"))
        self.server.wait_for("certificate, key and authorities were read again")
        with self.connect("operator") as comes:
            second = self.serial(comes)
            self.assertNotEqual(second, first)
            self.assertEqual(self.exchange(comes), 3)
        self.assertEqual(self.exchange(stays), 3)
        self.assertTrue(eventually(lambda: fetch()[ends] < time.time() + 8 * 86_400))

        # Who was a stranger is let in, once its authority is.
        self.refused("stranger", "unable to get local issuer certificate")
        with open(self.folder / "plant-ca.crt", "a", encoding="ascii") as file:
            file.write((self.folder / "other-ca.crt").read_text(encoding="ascii"))
        self.reload("were read again")
        # The client believes the plant's authority only: its own list of them is the first of the file.
        self.assertEqual(self.ask("stranger", 3, 0, 1)[0], 3)

        # Broken files: everything stays, and is said with its code.
        for content, code in (("no key\n", "R0114"), ((keep / "plc.key").read_text(encoding="ascii"), "R0115")):
            (self.folder / "plc.key").write_text(content, encoding="ascii")
            said = self.reload("the previous one holds")
            self.assertIn(code, said)
            self.assertNotIn("were read again", said)
            with self.connect("operator") as comes:
                self.assertEqual(self.serial(comes), second)
        (self.folder / "plc.key").unlink()
        self.assertRegex(self.reload("the previous one holds"), r"cell\.toml:\d+:\d+: C0512")
        self.assertEqual(self.ask("operator", 3, 0, 1)[0], 3)
        self.assertEqual(self.exchange(stays), 3)

        # Other names.
        for end in ("crt", "key"):
            shutil.copy(keep / f"plc.{end}", self.folder / f"third.{end}")
        shutil.copy(keep / "plc.key", self.folder / "plc.key")
        self.cell.write(CELL + ACCESS.replace("tls/plc.", "tls/third."))
        said = self.reload("the configuration was read again")
        self.assertRegex(said, r"C0464: 'modbus\.server\.tls\.certificate' is \"tls/third\.crt\" from now on")
        with self.connect("operator") as comes:
            self.assertEqual(self.serial(comes), first)

        # An acceptor is not closed by a reload: that needs a restart, and is said to.
        self.cell.write(CELL + "[[modbus.server.client]]\naddress = \"127.0.0.1\"\nread = [\"all\"]\n")
        said = self.reload("the configuration was read again")
        self.assertRegex(said, r"C0465: 'modbus\.server\.tls\.certificate' is left out now")
        self.assertEqual(self.ask("operator", 3, 0, 1)[0], 3)
        self.assertEqual(self.exchange(stays), 3)

    def test_plain_modbus(self):
        with socket.create_connection(("127.0.0.1", PORT), timeout=PATIENCE_S) as plain:
            plain.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 1, 3, 0, 1))
            try:
                self.assertNotEqual(plain.recv(300)[:2], b"\x00\x01")
            except ConnectionError:
                pass


if __name__ == "__main__":
    unittest.main()
