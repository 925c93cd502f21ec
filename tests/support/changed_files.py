"""Which files and lines of the tree a change touches, as git tells it: for tests that look more closely at what is new."""

import functools
import os
import pathlib
import re
import subprocess

# How many commits count as new on the main branch itself.
LAST_COMMITS = 10


def _git(root: pathlib.Path, *command: str) -> list[str] | None:
    """The lines that git answers; nothing where it fails (no repository, no such commit, no git)."""
    try:
        done = subprocess.run(["git", "-C", str(root), *command], capture_output=True, text=True)
    except FileNotFoundError:
        return None
    return done.stdout.splitlines() if done.returncode == 0 else None


def base_commit(root: pathlib.Path) -> str | None:
    """The commit that the change begins at: STEPWRIGHT_BASE, else the merge base with the main branch of origin, else, where
    that is the commit itself, the tenth before it, or the oldest that there is; in the long mode (STEPWRIGHT_LONG) the last
    release before it, if one is tagged. Nothing without history."""
    asked = os.environ.get("STEPWRIGHT_BASE")
    head = _git(root, "rev-parse", "HEAD")
    if head is None:
        return None
    for other in [asked] if asked else ["origin/HEAD", "origin/main"]:
        merged = _git(root, "merge-base", "HEAD", other)
        if merged and (asked or merged != head):
            return merged[0]
    if os.environ.get("STEPWRIGHT_LONG") and (released := _git(root, "describe", "--tags", "--abbrev=0", "HEAD^")):
        return released[0]
    before = _git(root, "rev-list", "--first-parent", f"--max-count={LAST_COMMITS + 1}", "HEAD")
    return before[-1] if before and len(before) > 1 else None


def changed_files(root: pathlib.Path) -> list[str] | None:
    """The paths, from the root, of files that differ from the base, with what is not committed and not even added yet: the
    latest commits first. Nothing without history."""
    base = base_commit(root)
    if base is None:
        return None
    names = _git(root, "ls-files", "--others", "--exclude-standard") or []
    names += _git(root, "diff", "--name-only", "HEAD") or []
    names += _git(root, "log", "--first-parent", "-m", "--format=", "--name-only", f"{base}..HEAD") or []
    return [name for name in dict.fromkeys(names) if name and (root / name).is_file()]


@functools.lru_cache(maxsize=1)
def _diffs(root: pathlib.Path, base: str) -> dict[str, list[str]]:
    """What changed, by file: one question, so that git follows files that have moved."""
    files: dict[str, list[str]] = {}
    lines: list[str] = []
    for line in _git(root, "diff", "-U0", "-M", base) or []:
        if line.startswith("+++ b/"):
            lines = files.setdefault(line[len("+++ b/"):], [])
        elif line.startswith("diff --git"):
            lines = []
        else:
            lines.append(line)
    return files


HUNK = re.compile(r"^@@ -\S+ \+(?P<first>\d+)(,(?P<count>\d+))? @@")


def changed_lines(root: pathlib.Path, name: str) -> list[tuple[int, int]]:
    """The lines of a file, first and last of each piece, that the change has written; lines that include a header do not
    count, since a header that moves changes them everywhere. All of a file that git does not know yet."""
    base = base_commit(root)
    if base is None or _git(root, "ls-files", "--error-unmatch", name) is None:
        return [(1, len((root / name).read_text(encoding="utf-8").splitlines()))]
    pieces: list[tuple[int, int]] = []
    number = 0
    # With the history of names: of a file that has moved only what is new in it.
    for line in _diffs(root, base).get(name, []):
        if hunk := HUNK.match(line):
            number = int(hunk["first"])
        elif line.startswith("+") and not line.startswith("+++"):
            if not line[1:].lstrip().startswith("#include"):
                if pieces and pieces[-1][1] == number - 1:
                    pieces[-1] = (pieces[-1][0], number)
                else:
                    pieces.append((number, number))
            number += 1
    return pieces
