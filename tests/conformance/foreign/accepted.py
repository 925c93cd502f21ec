#!/usr/bin/env python3
"""How much of other people's sources the compiler takes, and why not the rest.

    accepted.py [--compile PROGRAM] [--dialect NAME] [--names GLOB] [--pous] FOLDER...

Every ST file (.st, .txt) and PLCopen project (.xml) of a folder is checked on its own (`stepwright compile --check`);
files of equal content count once. With --pous the ST files of a folder are one library, and its POUs are counted: one
is refused if an error stands in it. Prints a table by folder and one by reason: the first error of each refused one.
"""

import argparse
import collections
import fnmatch
import json
import pathlib
import re
import subprocess
import sys
import tempfile

BEGIN = re.compile(r"^\s*(FUNCTION_BLOCK|FUNCTION|PROGRAM)\s+(\w+)", re.IGNORECASE)
END = re.compile(r"^\s*END_(FUNCTION_BLOCK|FUNCTION|PROGRAM)\b", re.IGNORECASE)
END_VAR = re.compile(r"\bEND_VAR\b", re.IGNORECASE)


def errors_of(options, paths):
    command = [options.compile, "compile", "--check", "--json", "-", "-W", "none"]
    if options.dialect:
        command += ["--dialect", options.dialect]
    run = subprocess.run(command + [str(each) for each in paths], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        found = json.loads(run.stdout)["diagnostics"]
    except ValueError:
        sys.exit(f"{options.compile} gave no report: {run.stderr.decode(errors='replace')[:500]}")
    return [each for each in found if each["severity"] == "error"]


def reason(error):
    message = re.sub(r"'[^']*'", "'...'", error["message"].split("': ", 1)[-1])
    return f"{error['code']} {re.sub(r'[0-9]+', 'N', message)}"


def sources_of(options, folder):
    """The files to check: one of each content."""
    seen = set()
    for path in sorted(pathlib.Path(folder).rglob("*")):
        if path.suffix.lower() not in (".st", ".txt", ".xml") or not fnmatch.fnmatch(path.name, options.names):
            continue
        text = path.read_bytes()
        if path.suffix.lower() == ".xml" and b"<project" not in text:
            continue
        if path.suffix.lower() == ".txt" and not re.search(rb"END_(FUNCTION|PROGRAM|TYPE|CONFIGURATION)", text, re.I):
            continue
        if text not in seen:
            seen.add(text)
            yield path


def check_files(options, folder):
    """Reason or None, by file."""
    verdicts = {}
    for path in sources_of(options, folder):
        errors = errors_of(options, [path])
        verdicts[str(path)] = reason(errors[0]) if errors else None
    return verdicts


class Library:
    """Copies of ST files, in which the statements of POUs can be taken out, so that what is wrong in one
    keeps no other from being checked."""

    def __init__(self, paths, folder):
        self.paths, self.lines, self.pous = [], [], []
        for number, path in enumerate(paths):
            self.lines.append(path.read_text(errors="surrogateescape").split("\n"))
            self.paths.append(pathlib.Path(folder) / f"{number}_{path.name}")
            self.find_pous(number)

    def find_pous(self, number):
        open_pou = None
        for index, line in enumerate(without_comments(self.lines[number])):
            begin = BEGIN.match(line)
            if begin and open_pou is None:
                open_pou = {"file": number, "name": begin[2], "first": index, "body": index + 1}
            if open_pou and END_VAR.search(line):
                open_pou["body"] = index + 1
            if open_pou and END.match(line):
                open_pou["last"] = index
                self.pous.append(open_pou)
                open_pou = None

    def write(self):
        for path, lines in zip(self.paths, self.lines):
            path.write_text("\n".join(lines), errors="surrogateescape")

    def pou_at(self, error):
        for each in self.pous:
            if str(self.paths[each["file"]]) == error["file"] and each["first"] < error["line"] <= each["last"] + 1:
                return each
        return None

    def empty(self, pou):
        lines = self.lines[pou["file"]]
        lines[pou["body"]:pou["last"]] = [""] * (pou["last"] - pou["body"])

    def erase(self, error):
        for number, path in enumerate(self.paths):
            if str(path) == error["file"]:
                self.lines[number][error["line"] - 1] = ""


def without_comments(lines):
    depth, result = 0, []
    for line in lines:
        kept, index = "", 0
        while index < len(line):
            two = line[index:index + 2]
            if two == "(*":
                depth, index = depth + 1, index + 2
            elif two == "*)" and depth:
                depth, index = depth - 1, index + 2
            else:
                kept += line[index] if depth == 0 else ""
                index += 1
        result.append(kept)
    return result


def check_pous(options, folder):
    """Reason or None, by POU."""
    with tempfile.TemporaryDirectory() as copies:
        library = Library(list(sources_of(options, folder)), copies)
        verdicts = {(each["file"], each["name"]): None for each in library.pous}
        while True:
            library.write()
            errors = errors_of(options, library.paths)
            if not errors:
                return verdicts
            emptied = set()
            for error in errors:
                pou = library.pou_at(error)
                key = (pou["file"], pou["name"]) if pou else None
                if pou and verdicts[key] is None:
                    verdicts[key] = reason(error)
                    emptied.add(key)
                    library.empty(pou)
                if not pou or (key not in emptied) or error["line"] <= pou["body"]:
                    library.erase(error)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compile", default="build/release/bin/stepwright-compile", help="the program")
    parser.add_argument("--dialect", help="of the sources")
    parser.add_argument("--names", default="*", help="only files of these names")
    parser.add_argument("--pous", action="store_true", help="a folder is a library: count POUs")
    parser.add_argument("--list", action="store_true", help="name what is refused")
    parser.add_argument("folders", nargs="+")
    options = parser.parse_args()
    check = check_pous if options.pous else check_files
    reasons = collections.Counter()
    print(f"{'sources':>8} {'accepted':>9}  folder")
    for folder in options.folders:
        verdicts = check(options, folder)
        refused = {name: why for name, why in verdicts.items() if why}
        print(f"{len(verdicts):>8} {len(verdicts) - len(refused):>9}  {folder}")
        reasons.update(refused.values())
        if options.list:
            for name, why in refused.items():
                print(f"  {name}: {why}")
    print(f"\n{'refused':>8}  reason")
    for why, count in reasons.most_common():
        print(f"{count:>8}  {why}")


if __name__ == "__main__":
    main()
