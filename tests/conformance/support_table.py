#!/usr/bin/env python3
"""The table of support in ladder/README.md, from the requirements and the language tests that cite them.

    support_table.py ROOT            checks that requirements, citations and table agree
    support_table.py ROOT --write    writes the table
"""

import pathlib
import re
import sys

ID = re.compile(r"REQ-61131-[0-9.]+-\d+")
BEGIN, END = "<!-- support table: begin -->", "<!-- support table: end -->"


def requirements(root):
    """Section -> ids, in the order of the list."""
    sections, current = {}, None
    for line in (root / "tests/conformance/requirements.md").read_text().splitlines():
        if line.startswith("## "):
            current = sections.setdefault(line[3:], [])
        elif line.startswith("- "):
            current.append(ID.search(line).group())
    return sections


def citations(root):
    """Id -> the programs that cite it."""
    cited = {}
    for path in sorted((root / "tests/st/programs").rglob("*.st")):
        for comment in re.findall(r"\(\* REQ (.*?)\*\)", path.read_text(), re.S):
            for each in comment.split():
                cited.setdefault(each, []).append(path)
    return cited


def problems(sections, cited):
    listed = [each for ids in sections.values() for each in ids]
    for each in sorted({each for each in listed if listed.count(each) > 1}):
        yield f"{each} is listed twice"
    for each in listed:
        if each not in cited:
            yield f"{each} is cited by no program"
    for each in sorted(set(cited) - set(listed)):
        yield f"{each} does not exist, yet {cited[each][0]} cites it"


def table(sections, cited):
    lines = ["| clause | requirements | programs |", "|---|---|---|"]
    for name, ids in sections.items():
        programs = {path for each in ids for path in cited.get(each, [])}
        lines.append(f"| {name} | {len(ids)} | {len(programs)} |")
    return "\n".join(lines)


def main():
    root = pathlib.Path(sys.argv[1])
    sections, cited = requirements(root), citations(root)
    found = list(problems(sections, cited))
    readme = root / "ladder/README.md"
    text = readme.read_text()
    before, rest = text.split(BEGIN)
    wanted = f"{before}{BEGIN}\n{table(sections, cited)}\n{END}{rest.split(END)[1]}"
    if "--write" in sys.argv:
        readme.write_text(wanted)
    elif text != wanted:
        found.append("the table in ladder/README.md is out of date: run tests/conformance/support_table.py . --write")
    stray = [path for path in (root / "tests/st/programs").glob("*.st")]
    found += [f"{path} lies in no folder, so no test runs it" for path in stray]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
