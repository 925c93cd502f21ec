"""The Debian package: what is in it, what it asks for, that it says nothing of the machine that built it, and that its
programs run from wherever it was unpacked. In the long mode also on a bare Debian: install, run, upgrade, remove, purge."""

import json
import os
import pathlib
import re
import shutil
import stat
import subprocess
import tempfile
import unittest

from clean_root import CleanRoot
from processes import BIN, PATIENCE_S, SOURCES, stepwright

PROGRAMS = "usr/libexec/stepwright"
UNITS = "usr/lib/systemd/system"
DOCUMENTS = "usr/share/doc/stepwright"
CELLS = "usr/share/stepwright/cells"
FIRMWARE = "usr/share/stepwright/firmware"
LINK = re.compile(r"\[[^\[\]]*\]\(([^()\s#]+)[^()\s]*\)")


PROGRAM = "PROGRAM Main\n  VAR n : UDINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
LINE = ('[cell]\nname = "line"\n[clock]\nmode = "real"\n[plant]\nkind = "none"\n'
        '[runtime]\nprogram = "line.swb"\nautostart = true\n[hmi]\nanonymous = "viewer"\n')
# Until the page says by way of the link that the runtime scans.
PAGE_ANSWERS = """
for attempt in $(seq 600); do
  if exec 3<>/dev/tcp/127.0.0.1/8080; then
    printf 'GET /api/program HTTP/1.0\\r\\nHost: 127.0.0.1:8080\\r\\n\\r\\n' >&3
    answer=$(cat <&3)
    exec 3<&-
    case $answer in *" 200 "*) echo "$answer" | head -1; exit 0 ;; esac
  fi 2>/dev/null
  sleep 0.5
done
exit 1
"""


def output_of(*command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=PATIENCE_S, check=False, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


# Plants in Python that people take as a start for their own.
EXAMPLES = re.compile(r"/cells/shared_plant/|/doc/examples/")

def make_package(folder, revision=1):
    path = output_of(SOURCES / "scripts/package", "--built", BIN.parent, "--output", folder, "--revision", revision, "--quick")
    return pathlib.Path(path.strip())


def setUpModule():
    global folder, package, root
    folder = pathlib.Path(tempfile.mkdtemp(prefix="stepwright-test-"))
    unittest.addModuleCleanup(shutil.rmtree, folder, ignore_errors=True)
    package = make_package(folder)
    root = folder / "root"
    output_of("dpkg-deb", "--extract", package, root)


def program_names():
    source = (SOURCES / "programs/stepwright/main.cpp").read_text(encoding="utf-8")
    # Processes of plants are started by the runtime alone.
    return {"stepwright", "stepwright-plant-fmu", "stepwright-plant-st", *re.findall(r'Command\{"[a-z0-9-]+", "(stepwright-[a-z0-9-]+)",', source)}


def programs():
    return sorted((root / PROGRAMS).iterdir())


def field(name, of=None):
    return output_of("dpkg-deb", "--field", of or package, name).strip()


class Contents(unittest.TestCase):
    def test_its_version_is_the_project_s(self):
        version = stepwright("--version").stdout.split()[1]
        self.assertEqual((field("Package"), field("Version")), ("stepwright", f"{version}-1"))
        self.assertEqual(package.name, f"stepwright_{version}-1_{field('Architecture')}.deb")

    def test_every_program_is_there_and_nothing_else(self):
        self.assertEqual({each.name for each in programs()}, program_names())
        link = root / "usr/bin/stepwright"
        self.assertEqual(link.resolve(), (root / PROGRAMS / "stepwright").resolve())
        self.assertEqual([each.name for each in (root / "usr/bin").iterdir()], ["stepwright"])

    def test_manual_completion_and_papers_are_there(self):
        pages = {each.name for each in (SOURCES / "programs/man").iterdir()}
        self.assertEqual({each.name for each in (root / "usr/share/man/man1").iterdir()}, {f"{each}.gz" for each in pages})
        completion = (root / "usr/share/bash-completion/completions/stepwright").read_text(encoding="utf-8")
        self.assertEqual(completion, (SOURCES / "programs/completion/stepwright.bash").read_text(encoding="utf-8"))
        found = {each.name for each in (root / DOCUMENTS).iterdir()}
        self.assertLessEqual({"copyright", "changelog.gz", "changelog.Debian.gz", "README.md", "examples", "runtime"}, found)
        text = (root / DOCUMENTS / "copyright").read_text(encoding="utf-8")
        for words in ("License: Apache-2.0", "License: svelte", "License: uplot", "License: diff", "Permission is hereby granted"):
            self.assertIn(words, text)
        changes = output_of("zcat", root / DOCUMENTS / "changelog.Debian.gz")
        self.assertTrue(changes.startswith(f"stepwright ({field('Version')}) "), changes)

    def test_every_unit_is_there_and_the_user_of_all(self):
        units = {each.name for each in (SOURCES / "programs/systemd").glob("*.service")}
        self.assertIn("stepwright@.service", units)
        self.assertEqual({each.name for each in (root / UNITS).iterdir()}, units)
        users = {re.search(r"^User=(.*)$", (root / UNITS / each).read_text(encoding="utf-8"), re.M)[1] for each in units}
        self.assertEqual(users, {"stepwright"})
        self.assertIn("\nu stepwright ", (root / "usr/lib/sysusers.d/stepwright.conf").read_text(encoding="utf-8"))

    def test_every_cell_is_there_with_all_that_its_files_name(self):
        self.assertLessEqual({"bench", "conveyor", "fleet", "tugger", "robot_cell"},
                             {each.name for each in (root / CELLS).iterdir()})
        for file in (root / CELLS).rglob("*.toml"):
            text = file.read_text(encoding="utf-8")
            for named in re.findall(r'^\w+ = \[?"([^"]+\.(?:toml|pddl|hddl|json|yaml|urdf|srdf|svg|geojson|st|xml))"', text, re.M):
                self.assertTrue((file.parent / named).is_file(), f"{file} names {named}")

    def test_images_for_boards_are_there(self):
        images = {each.stem for each in (BIN.parent / "firmware").glob("*.elf")}
        self.assertGreater(len(images), 1)
        self.assertEqual({each.stem for each in (root / FIRMWARE).iterdir()}, images)
        for image in (root / FIRMWARE).iterdir():
            header = output_of("readelf", "--file-header", image)
            self.assertRegex(header, r"Machine: +ARM")

    def test_every_link_of_a_document_leads_to_something(self):
        seen = 0
        for document in (root / "usr/share").rglob("*.md"):
            for target in LINK.findall(document.read_text(encoding="utf-8")):
                if re.match(r"[a-z]+:", target):
                    continue
                with self.subTest(document=document.relative_to(root), target=target):
                    self.assertTrue((document.parent / target).exists())
                seen += 1
        self.assertGreater(seen, 300)
        planning = (root / DOCUMENTS / "doc/planning.md").read_text(encoding="utf-8")
        self.assertIn("(../tests/cells/bench/domain.pddl)", planning, "the examples are those that are installed")

    def test_nothing_of_the_tests_and_nothing_that_others_may_write(self):
        for path in root.rglob("*"):
            with self.subTest(path=path.relative_to(root)):
                if not EXAMPLES.search(str(path)):
                    self.assertNotIn(path.suffix, (".py", ".cpp", ".pyc"))
                self.assertNotEqual(path.name, "CMakeLists.txt")
                if not path.is_symlink():
                    mode = stat.S_IMODE(path.stat().st_mode)
                    wanted = 0o755 if path.is_dir() or path.parent == root / PROGRAMS else 0o644
                    self.assertEqual(mode, wanted, oct(mode))
        owners = {line.split()[1] for line in output_of("dpkg-deb", "--contents", package).splitlines()}
        self.assertEqual(owners, {"root/root"})

    def test_its_sums_are_right(self):
        control = folder / "control"
        output_of("dpkg-deb", "--control", package, control)
        told = output_of("md5sum", "--check", "--quiet", control / "md5sums", cwd=root)
        self.assertEqual(told, "")
        listed = {line.split("  ", 1)[1] for line in (control / "md5sums").read_text(encoding="utf-8").splitlines()}
        files = {str(path.relative_to(root)) for path in root.rglob("*") if path.is_file() and not path.is_symlink()}
        self.assertEqual(listed, files)

    def test_its_scripts_are_shell_s(self):
        control = folder / "scripts"
        output_of("dpkg-deb", "--control", package, control)
        for name in ("postinst", "prerm", "postrm"):
            self.assertTrue(os.access(control / name, os.X_OK))
            self.assertTrue((control / name).read_text(encoding="utf-8").startswith("#!/bin/sh\nset -e\n"))
            output_of("sh", "-n", control / name)


class Programs(unittest.TestCase):
    def test_they_are_stripped(self):
        for program in programs():
            sections = output_of("readelf", "--section-headers", "--wide", program)
            self.assertIn(" .text ", sections)
            for section in (".symtab", ".debug_info"):
                self.assertNotIn(f" {section} ", sections, program.name)

    def test_nothing_tells_where_they_were_built(self):
        for path in root.rglob("*"):
            if path.is_file() and not path.is_symlink():
                data = path.read_bytes()
                for place in (SOURCES, BIN.parent):
                    self.assertNotIn(os.fsencode(place) + b"/", data, f"{path} names {place}")

    def test_nothing_has_a_search_path_of_its_own(self):
        for program in programs():
            self.assertNotRegex(output_of("readelf", "--dynamic", program), r"RPATH|RUNPATH")

    def test_the_package_of_every_library_is_a_dependency(self):
        libraries = set()
        for program in programs():
            libraries |= set(re.findall(r"\(NEEDED\).*\[(.*)\]", output_of("readelf", "--dynamic", program)))
        self.assertGreater(len(libraries), 10)
        places = dict(re.findall(r"^\s*(\S+) => (\S+)", "".join(output_of("ldd", each) for each in programs()), re.M))
        depends = {each.split()[0] for each in field("Depends").split(", ")}
        real = {each: pathlib.Path(places[each]) for each in libraries if not each.startswith("ld-linux")}
        spellings = {each: {str(path), str(path.resolve()), f"/usr{path}"} for each, path in real.items()}
        # Asked once: each question reads the lists of all packages. Not every spelling is known to it.
        found = subprocess.run(["dpkg-query", "--search", *sorted(set().union(*spellings.values()))], capture_output=True, text=True, check=False)
        owners = {path: owner.split(":")[0] for owner, path in re.findall(r"^(\S+): (\S+)$", found.stdout, re.M)}
        shown = output_of("dpkg-query", "--show", "--showformat=${Package}: ${Provides}\\n", *sorted(set(owners.values())))
        # A package may stand in the list by a name that it provides.
        names = {owner: {owner, *(each.split()[0] for each in provided.split(", ") if each)}
                 for owner, provided in re.findall(r"^(\S+): (.*)$", shown, re.M)}
        for library, paths in spellings.items():
            owner = next((owners[each] for each in paths if each in owners), None)
            self.assertIsNotNone(owner, library)
            self.assertTrue(names[owner] & depends, library)
        self.assertFalse([each for each in depends if each.endswith("-dev") or each in ("g++", "gcc", "cmake", "nodejs")])

    def test_an_unpacked_package_runs_its_cells(self):
        command = root / "usr/bin/stepwright"
        names = output_of(command, "demo", "--list", cwd="/").split()
        self.assertEqual(names, sorted(each.parent.name for each in (root / CELLS).glob("*/cell.toml")))
        self.assertIn("bench", names)
        report = folder / "report.json"
        output_of(command, "demo", "bench", "--headless", "--fast", "--no-compare", "--json", report, cwd="/")
        self.assertEqual(json.loads(report.read_text(encoding="utf-8"))["plan_cost"], 108)

    def test_a_cell_that_is_missing_is_told_with_those_that_are_there(self):
        done = subprocess.run([root / "usr/bin/stepwright", "demo", "nosuch"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"M0002: there is no cell 'nosuch'\n.*known cells: .*bench, .*conveyor")


class Script(unittest.TestCase):
    def refused(self, *arguments):
        done = subprocess.run([SOURCES / "scripts/package", *arguments], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        return done.stderr

    def test_wrong_options_are_refused(self):
        self.assertIn("--revision is a whole number from 1, not 'x'", self.refused("--revision", "x"))
        self.assertIn("scripts/package [--built FOLDER]", self.refused("--nosuch", "x"))


@unittest.skipUnless(os.environ.get("STEPWRIGHT_LONG"), "the long mode installs it on a bare Debian: scripts/test --long")
class BareDebian(unittest.TestCase):
    def present(self, path):
        return (self.debian.folder / path).exists()

    def runs_by_its_units(self, debian):
        """What the units of a cell say is done as systemd does it: as their user, in their order, conditions first."""
        (debian.folder / "etc/stepwright/line.st").write_text(PROGRAM, encoding="utf-8")
        (debian.folder / "etc/stepwright/line.toml").write_text(LINE, encoding="utf-8")
        done = debian.run("stepwright", "compile", "/etc/stepwright/line.st", "-o", "/etc/stepwright/line.swb")
        self.assertEqual(done.returncode, 0, done.stderr)
        script = "set -u\nas_user() { exec setpriv --reuid=stepwright --regid=stepwright --clear-groups \"$@\"; }\n"
        script += "install -d -o stepwright -g stepwright -m 700 /var/lib/stepwright/line\n"
        for name in ("guard", "runtime", "gateway", "modbus-client", "link", "supervisor", "hmi", "modbus-server"):
            unit = (root / UNITS / f"stepwright-{name}@.service").read_text(encoding="utf-8").replace("%i", "line")
            self.assertIn("\nUser=stepwright\n", unit)
            start = re.search(r"^ExecStart=(.*)$", unit, re.M)[1]
            condition = re.search(r"^ExecCondition=(.*)$", unit, re.M)
            script += f"if (as_user {condition[1] if condition else 'true'}); then echo started {name}; (as_user {start}) & fi\n"
        script += PAGE_ANSWERS
        done = debian.run("bash", "-c", script)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(re.findall(r"^started (.*)$", done.stdout, re.M), ["runtime", "link", "hmi"])
        self.assertIn(" 200 ", done.stdout)

    def test_install_run_upgrade_remove_purge(self):
        self.debian = debian = CleanRoot()
        self.addCleanup(debian.remove)
        debian.apt("update")
        debian.apt("install", debian.take(package))
        for compiler in ("g++", "gcc", "cc", "clang", "cmake", "node"):
            self.assertFalse(self.present(f"usr/bin/{compiler}"), compiler)
        self.assertIn("\nstepwright:x:", (debian.folder / "etc/passwd").read_text(encoding="utf-8"))

        # As the units run it: as their user, who may write nowhere but into the state folder.
        as_user = ("setpriv", "--reuid=stepwright", "--regid=stepwright", "--clear-groups")
        for cell in ("bench", "bench_model", "tugger"):
            done = debian.run(*as_user, "stepwright", "demo", cell, "--headless", "--fast", "--no-compare")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = debian.run("systemd-analyze", "verify", *(f"{each.name[:-8]}line.service" for each in (root / UNITS).iterdir()))
        self.assertEqual([line for line in done.stderr.splitlines() if "stepwright" in line and "man stepwright" not in line], [])

        self.runs_by_its_units(debian)
        state = debian.folder / "var/lib/stepwright/line"
        (state / "retained").write_text("42", encoding="utf-8")
        newer = make_package(folder, revision=2)
        debian.apt("install", debian.take(newer))
        self.assertEqual(debian.run("dpkg-query", "--show", "--showformat=${Version}", "stepwright").stdout, field("Version", newer))
        self.assertEqual((state / "retained").read_text(encoding="utf-8"), "42")

        debian.apt("remove", "stepwright")
        for gone in (PROGRAMS, "usr/bin/stepwright", CELLS, f"{UNITS}/stepwright@.service"):
            self.assertFalse(self.present(gone), gone)
        self.assertEqual((state / "retained").read_text(encoding="utf-8"), "42")
        debian.apt("purge", "stepwright")
        self.assertFalse(self.present("var/lib/stepwright"))
        self.assertTrue(self.present("etc/stepwright/line.toml"))


if __name__ == "__main__":
    unittest.main()
