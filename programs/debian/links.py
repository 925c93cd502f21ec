#!/usr/bin/env python3
"""Takes links and pictures out of installed documents that lead to what is not installed: their words stay.

    links.py FOLDER
"""

import pathlib
import re
import sys

LINK = re.compile(r"!?\[([^\[\]]*)\]\(([^()\s]+)\)")


def is_there(document, target):
    path = target.split("#")[0]
    return not path or re.match(r"[a-z]+:", path) or (document.parent / path).exists()


def main(folder):
    for document in sorted(pathlib.Path(folder).rglob("*.md")):
        text = document.read_text(encoding="utf-8")
        kept = LINK.sub(lambda link: link[0] if is_there(document, link[2]) else link[1], text)
        if kept != text:
            document.write_text(kept, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1])
