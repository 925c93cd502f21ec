"""Which files of the tree a change touches, as git tells it: for tests that look more closely at what is new."""

import os
import pathlib
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
    that is the commit itself, the tenth before it, or the oldest that there is. Nothing without history."""
    asked = os.environ.get("STEPWRIGHT_BASE")
    head = _git(root, "rev-parse", "HEAD")
    if head is None:
        return None
    for other in [asked] if asked else ["origin/HEAD", "origin/main"]:
        merged = _git(root, "merge-base", "HEAD", other)
        if merged and (asked or merged != head):
            return merged[0]
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
