#!/usr/bin/env python3
"""Keeps the documents readable: README.md has at most 120 lines; the glossary has one term a row, in alphabetical order and
each once; every relative link of a Markdown file leads to a file of the tree, and its anchor to a heading there; a code of a
message has one row in all tables of codes; a page of the user's book (doc/*.md) has its first example within two screens;
the document of the viewer protocol names the version that the server speaks wherever it names one; a header opens with the
role of what it declares ("Journal of a run: ..."), and not with a riddle ("What ...").

Prints each problem as file:line and exits with 1.
"""

import pathlib
import re
import subprocess
import sys
import urllib.parse

README_LINES = 120
SCREENS_LINES = 50  # two screens
GLOSSARY = "doc/glossary.md"
ROW = re.compile(r"^\| (?P<term>[^|]+) \| [^|]+ \|$")
LINK = re.compile(r"\[[^\]]*\]\((?P<target>[^)\s]+)\)")
HEADING = re.compile(r"^#{1,6} +(?P<title>.+?)\s*$")
FENCE = re.compile(r"^\s*```")
PROTOCOL = "hmi_web/doc/protocol.md"
SPOKEN = re.compile(r"kProtocolVersion = (\d+);")
TOLD = re.compile(r"^(?:# .*version|\| `protocol` \| number \|) (\d+)")
RIDDLE = re.compile(r"// What\b")
CODE_ROW = re.compile(r"^\| (?P<code>[A-Z][0-9]{4}) \|")


def prose(text: str) -> list[tuple[int, str]]:
    """The numbered lines of a document that are no code: blocks between fences and texts in backquotes are left out."""
    found, in_code = [], False
    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line):
            in_code = not in_code
        elif not in_code:
            found.append((number, re.sub(r"`[^`]*`", lambda code: "`" * (code.end() - code.start()), line)))
    return found


def long_readme(text: str) -> list[str]:
    lines = len(text.splitlines())
    return [f"README.md:{lines}: more than {README_LINES} lines"] if lines > README_LINES else []


def unsorted_terms(text: str) -> list[str]:
    problems, before, seen = [], "", {}
    rows = [(number, ROW.match(line)) for number, line in enumerate(text.splitlines(), 1) if line.startswith("|")]
    for number, row in rows[2:]:  # the first two are the head of the table
        if not row:
            problems.append(f"{GLOSSARY}:{number}: a row is a term and its meaning, without further bars")
            continue
        term = row["term"].casefold()
        if "," in term:
            problems.append(f"{GLOSSARY}:{number}: '{term}' is several terms: a row for each")
        if term in seen:
            problems.append(f"{GLOSSARY}:{number}: '{term}' stands in line {seen[term]} already")
        elif term < before:
            problems.append(f"{GLOSSARY}:{number}: '{term}' comes before '{before}'")
        seen.setdefault(term, number)
        before = term
    return problems if len(rows) > 2 else [f"{GLOSSARY}:1: no table of terms"]


def repeated_codes(name: str, text: str, seen: dict[str, str]) -> list[str]:
    """Codes that have a row already, and so perhaps two meanings."""
    problems = []
    for number, line in enumerate(text.splitlines(), 1):
        if not (row := CODE_ROW.match(line)):
            continue
        code = row["code"]
        if code in seen:
            problems.append(f"{name}:{number}: {code} stands in {seen[code]} already: a code has one meaning and one row")
        seen.setdefault(code, f"{name}:{number}")
    return problems


def anchors(text: str) -> set[str]:
    """The anchors of a document's headings, as GitHub makes them: lower case, no punctuation, hyphens for spaces."""
    found: set[str] = set()
    in_code = False
    for line in text.splitlines():
        if FENCE.match(line):
            in_code = not in_code
        heading = None if in_code else HEADING.match(line)
        if heading:
            title = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading["title"])
            slug = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
            again = 0
            while (f"{slug}-{again}" if again else slug) in found:
                again += 1
            found.add(f"{slug}-{again}" if again else slug)
    return found


def broken_links(root: pathlib.Path, name: str, texts: dict[str, str]) -> list[str]:
    problems = []
    for number, line in prose(texts[name]):
        for link in LINK.finditer(line):
            target = urllib.parse.unquote(link["target"])
            if re.match(r"[a-z]+:", target):
                continue  # another site
            path, _, anchor = target.partition("#")
            file = (root / name).parent / path if path else root / name
            if not file.exists():
                problems.append(f"{name}:{number}: there is no {target}")
            elif anchor and file.suffix == ".md" and anchor not in anchors(file.read_text(encoding="utf-8")):
                problems.append(f"{name}:{number}: {path or name} has no heading #{anchor}")
    return problems


def late_example(name: str, text: str) -> list[str]:
    lines = text.splitlines()
    first = next((number for number, line in enumerate(lines) if FENCE.match(line)), len(lines))
    return [f"{name}:1: no example within {SCREENS_LINES} lines"] if first > SCREENS_LINES else []


def other_versions(text: str, header: str) -> list[str]:
    spoken = SPOKEN.search(header)[1]
    told = [(number, TOLD.match(line)) for number, line in enumerate(text.splitlines(), 1)]
    return [f"{PROTOCOL}:{number}: version {match[1]}, and the server speaks {spoken}" for number, match in told if match and match[1] != spoken]


def riddles(name: str, text: str) -> list[str]:
    """The opening of a header, which is its first line that begins with a comment, where it says no role."""
    lines = text.splitlines()
    first = next((number for number, line in enumerate(lines, 1) if line.startswith("//")), None)
    if first is None or not RIDDLE.match(lines[first - 1]):
        return []
    return [f"{name}:{first}: an opening says the role of what is declared (\"Journal of a run: ...\"), and not \"What ...\""]


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    listed = subprocess.run(
        ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard", "*.md", "*.h"],
        capture_output=True, check=True, text=True,
    ).stdout.split("\0")
    files = {name: (root / name).read_text(encoding="utf-8") for name in listed if name and (root / name).is_file()}
    headers = {name: text for name, text in files.items() if name.endswith(".h")}
    texts = {name: text for name, text in files.items() if name.endswith(".md")}
    problems = long_readme(texts["README.md"]) + unsorted_terms(texts[GLOSSARY])
    for name, text in texts.items():
        if re.fullmatch(r"doc/[\w-]+\.md", name) and name not in (GLOSSARY, "doc/README.md"):
            problems += late_example(name, text)
    problems += other_versions(texts[PROTOCOL], (root / "hmi_web/protocol/messages.h").read_text(encoding="utf-8"))
    for name in sorted(headers):
        problems += riddles(name, headers[name])
    codes: dict[str, str] = {}
    for name in sorted(texts):
        problems += broken_links(root, name, texts) + repeated_codes(name, texts[name], codes)
    print("\n".join(problems) or f"{len(texts)} documents and the openings of {len(headers)} headers are in order")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
