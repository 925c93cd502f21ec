"""The processes and their init system: READY, STATUS, the watchdog's beat and its silence, STOPPING, RELOADING; and
the units as systemd itself reads and judges them."""

import ctypes
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from init_system import InitSystem
from processes import NO_PLANT, PATIENCE_S, SOURCES, Cell, eventually, stepwright

UNITS = sorted((SOURCES / "programs/systemd").glob("*.service"))
REAL = NO_PLANT + '[clock]\nmode = "real"\n'

PTRACE_SEIZE, PTRACE_INTERRUPT, PTRACE_DETACH = 0x4206, 0x4207, 17
libc = ctypes.CDLL(None, use_errno=True)
libc.ptrace.argtypes = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p]


class Notify(unittest.TestCase):
    def cell(self, more):
        cell = Cell(more)
        self.addCleanup(cell.__exit__)
        return cell

    def init(self, cell, **options):
        init = InitSystem(cell.folder, **options)
        self.addCleanup(init.close)
        return init

    def test_it_is_ready_when_it_serves_and_says_when_it_stops(self):
        cell = self.cell(REAL)
        init = self.init(cell)
        runtime = cell.start("runtime", env=init.environment)
        self.assertTrue(init.heard(r"^READY=1\nSTATUS=.*listens on"))
        self.assertTrue(cell.socket.exists())
        self.assertTrue(init.heard(r"^STATUS=no program is loaded"))
        cell.load(1_000)
        self.assertTrue(init.heard(r"^STATUS=running"))
        self.assertEqual(runtime.end(), 0)
        self.assertIn("STOPPING=1", init.listen())

    def test_a_runtime_that_refuses_is_never_ready(self):
        cell = self.cell('[plant.ports]\nfc9 = "%IX0.0"\n')
        init = self.init(cell)
        self.assertEqual(cell.start("runtime", env=init.environment).wait(), 1)
        self.assertEqual([each for each in init.listen() if "READY" in each], [])

    def test_the_watchdog_is_fed_while_the_scan_is_alive_and_not_while_it_hangs(self):
        cell = self.cell(REAL)
        init = self.init(cell)
        runtime = cell.start("runtime", env=init.environment)
        self.assertTrue(init.heard("READY=1"))
        self.assertGreaterEqual(init.beats(2.0), 4)
        cell.load(1_000)
        self.assertGreaterEqual(init.beats(2.0), 4)
        threads = [int(tid) for tid in os.listdir(f"/proc/{runtime.pid}/task") if int(tid) != runtime.pid]
        try:
            for tid in threads:
                self.assertEqual(libc.ptrace(PTRACE_SEIZE, tid, None, None), 0, os.strerror(ctypes.get_errno()))
                libc.ptrace(PTRACE_INTERRUPT, tid, None, None)
            time.sleep(1.0)  # until the patience with the scan is over
            self.assertEqual(init.beats(2.0), 0)
            # The service itself lives: it is the scan that it no longer vouches for.
            self.assertEqual(cell.figure("stepwright_up"), 1)
        finally:
            for tid in threads:
                os.waitpid(tid, 0x40000000)  # __WALL: it has stopped
                libc.ptrace(PTRACE_DETACH, tid, None, None)
        self.assertTrue(eventually(lambda: init.beats(0.5) > 0))

    def test_a_process_that_is_stopped_altogether_falls_silent(self):
        cell = self.cell(REAL)
        init = self.init(cell)
        runtime = cell.start("runtime", env=init.environment)
        self.assertTrue(init.heard("READY=1"))
        runtime.send(signal.SIGSTOP)
        self.assertEqual(init.beats(1.0), 0)
        runtime.send(signal.SIGCONT)
        self.assertTrue(eventually(lambda: init.beats(0.5) > 0))

    def test_without_a_watchdog_there_is_no_beat(self):
        cell = self.cell(REAL)
        init = self.init(cell, watchdog=False)
        cell.start("runtime", env=init.environment)
        self.assertTrue(init.heard("READY=1"))
        self.assertEqual(init.beats(0.5), 0)

    def test_a_barrier_is_no_hanging_scan(self):
        cell = self.cell(NO_PLANT + "[clock]\nspeed = 1.0\n[safe_state]\nsupervisor_lost_after_ms = 60000\n")
        init = self.init(cell)
        cell.start("runtime", env=init.environment)
        self.assertTrue(init.heard("READY=1"))
        cell.load(10_000, "barrier")
        self.assertTrue(init.heard("waiting for the supervisor"))
        time.sleep(1.0)
        self.assertGreaterEqual(init.beats(2.0), 4)

    def test_reloading_is_told(self):
        cell = self.cell(REAL)
        init = self.init(cell)
        runtime = cell.start("runtime", env=init.environment)
        self.assertTrue(init.heard("READY=1"))
        runtime.send(signal.SIGHUP)
        self.assertTrue(init.heard(r"^RELOADING=1\nMONOTONIC_USEC=\d+"))
        self.assertTrue(eventually(lambda: sum("READY=1" in each for each in init.listen()) == 2))

    def test_link_and_page_are_ready_and_alive_too(self):
        cell = self.cell(NO_PLANT + "[hmi]\nport = 0\n")
        for name in ("link", "hmi"):
            folder = cell.folder / name
            folder.mkdir()
            init = InitSystem(folder)
            self.addCleanup(init.close)
            process = cell.start(name, env=init.environment)
            self.assertTrue(init.heard("READY=1"), process.output())
            self.assertGreaterEqual(init.beats(2.0), 4)
            self.assertEqual(process.end(), 0)
            self.assertIn("STOPPING=1", init.listen())


@unittest.skipUnless(shutil.which("systemd-analyze"), "no systemd-analyze on this machine")
class Units(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        for unit in UNITS:  # the command need not be installed for the rest to be judged
            text = unit.read_text(encoding="utf-8").replace("/usr/bin/stepwright ", "/bin/true ")
            (self.folder / unit.name).write_text(text, encoding="utf-8")

    def test_there_is_one_for_each_process(self):
        self.assertEqual([unit.name for unit in UNITS],
                         [f"stepwright-{name}@.service"
                          for name in ("gateway", "guard", "hmi", "link", "modbus-client", "modbus-server", "runtime",
                                       "supervisor")] + ["stepwright@.service"])

    def test_systemd_finds_nothing_wrong(self):
        for unit in UNITS:
            instance = unit.name.replace("@", "@cell")
            done = subprocess.run(["systemd-analyze", "verify", self.folder / instance], capture_output=True, text=True,
                                  timeout=PATIENCE_S, check=False)
            found = [line for line in done.stderr.splitlines() if "stepwright" in line and "man stepwright" not in line]
            self.assertEqual(found, [])

    def test_who_needs_the_cell_s_program_wants_whichever_unit_runs_it(self):
        hosts = ("stepwright-runtime@%i.service", "stepwright-gateway@%i.service")
        for name in ("link", "supervisor", "hmi", "modbus-server"):
            text = (SOURCES / f"programs/systemd/stepwright-{name}@.service").read_text(encoding="utf-8")
            for key in ("After", "Wants"):
                self.assertIn(f"\n{key}={' '.join(hosts)}\n", text, name)
        for name in ("runtime", "gateway"):
            text = (SOURCES / f"programs/systemd/stepwright-{name}@.service").read_text(encoding="utf-8")
            self.assertIn(f"\nExecCondition=/usr/bin/stepwright {name} --concerned --config /etc/stepwright/%i.toml\n", text)

    def test_the_conditions_start_one_of_the_two(self):
        """As ExecCondition= reads it: 0 goes on, 1 to 254 leaves the unit alone without a failure."""
        kinds = {"": "runtime",
                 '[controller]\nkind = "modbus-tcp"\nhost = "10.0.0.7"\n': "gateway",
                 # Wrong files are for the process that is probably meant to refuse, with its diagnostics.
                 '[controller]\nkind = "modbus-tcp"\n': "gateway",
                 '[controller]\nkind = "modbus"\n': "runtime",
                 "[controller\n": "runtime"}
        for text, wanted in kinds.items():
            with self.subTest(text=text):
                file = self.folder / "cell.toml"
                file.write_text('[cell]\nname = "x"\n' + text, encoding="utf-8")
                codes = {name: stepwright(name, "--concerned", "--config", file).returncode
                         for name in ("runtime", "gateway")}
                self.assertEqual(codes, {"runtime": 1, "gateway": 1, wanted: 0})

    def test_the_unit_of_a_cell_wants_those_of_its_processes_which_stop_and_reload_with_it(self):
        cell = UNITS[-1].read_text(encoding="utf-8")
        self.assertIn("\nAssertPathExists=/etc/stepwright/%i.toml\n", cell)
        wanted = {key: " ".join(re.findall(rf"(?m)^{key}=(.*)$", cell)).split() for key in ("Wants", "PropagatesReloadTo")}
        members = UNITS[:-1]
        self.assertEqual(sorted(wanted["Wants"]), [unit.name.replace("@.", "@%i.") for unit in members])
        reloaded = [unit for unit in members if "\nExecReload=" in unit.read_text(encoding="utf-8")]
        self.assertEqual(sorted(wanted["PropagatesReloadTo"]), [unit.name.replace("@.", "@%i.") for unit in reloaded])
        for unit in members:
            self.assertIn("\nPartOf=stepwright@%i.service\n", unit.read_text(encoding="utf-8"), unit.name)

    def test_a_process_that_the_cell_does_not_want_stays_away(self):
        file = self.folder / "cell.toml"
        cells = {"": [], "[modbus.server]\nenabled = true\n": ["modbus-server"], '[io]\nkind = "modbus"\n': ["modbus-client"],
                 '[ltl]\nproblem = "hall.json"\n': ["supervisor"], "[modbus\n": []}
        for text, wanted in cells.items():
            with self.subTest(text=text):
                file.write_text('[cell]\nname = "x"\n' + text, encoding="utf-8")
                codes = {name: stepwright(name, "--concerned", "--config", file).returncode
                         for name in ("modbus-client", "modbus-server", "supervisor")}
                self.assertEqual(codes, {name: 0 if name in wanted else 1 for name in codes})
        for name in ("modbus-client", "modbus-server", "supervisor"):
            text = (SOURCES / f"programs/systemd/stepwright-{name}@.service").read_text(encoding="utf-8")
            self.assertIn(f"\nExecCondition=/usr/bin/stepwright {name} --concerned --config /etc/stepwright/%i.toml\n", text)

    def test_the_guard_has_a_unit_of_its_own_that_the_runtime_wants(self):
        text = (SOURCES / "programs/systemd/stepwright-runtime@.service").read_text(encoding="utf-8")
        for key in ("After", "Wants"):
            self.assertIn(f"\n{key}=stepwright-guard@%i.service\n", text)
        file = self.folder / "cell.toml"
        for text, wanted in {"": 1, '[io]\nkind = "modbus"\n': 0, '[io]\nkind = "shared_memory"\n': 1,
                             '[io]\nkind = "shared_memory"\n[guard]\nenabled = true\n': 0, "[guard\n": 1}.items():
            with self.subTest(text=text):
                file.write_text('[cell]\nname = "x"\n' + text, encoding="utf-8")
                self.assertEqual(stepwright("guard", "--concerned", "--config", file).returncode, wanted)

    def test_their_exposure_is_at_most_2_5(self):
        for unit in UNITS:
            done = subprocess.run(["systemd-analyze", "security", "--offline=yes", "--no-pager", self.folder / unit.name],
                                  capture_output=True, text=True, timeout=PATIENCE_S, check=False)
            level = re.search(r"Overall exposure level for \S+: ([\d.]+)", done.stdout)
            self.assertTrue(level, done.stdout + done.stderr)
            print(unit.name, level.group(1))
            self.assertLessEqual(float(level.group(1)), 2.5)

    def test_what_the_scan_needs_is_granted_and_no_more(self):
        text = (SOURCES / "programs/systemd/stepwright-runtime@.service").read_text(encoding="utf-8")
        for line in ("AmbientCapabilities=CAP_SYS_NICE CAP_IPC_LOCK", "CapabilityBoundingSet=CAP_SYS_NICE CAP_IPC_LOCK",
                     "NoNewPrivileges=yes", "ProtectSystem=strict", "RestrictAddressFamilies=AF_UNIX", "WatchdogSec=2",
                     "Restart=on-failure", "Type=notify", "LimitMEMLOCK=infinity"):
            self.assertIn(f"\n{line}\n", text)
        self.assertRegex(text, r"\nMemoryMax=\d+M\n")
        self.assertRegex(text, r"\nLimitRTPRIO=\d+\n")


if __name__ == "__main__":
    unittest.main()
