"""One of eight parts in each run, where an emulator makes the whole too long: the next run in the same build folder takes the
next part once this one has passed, so that eight runs that pass have had everything. STEPWRIGHT_AARCH64_PART=3 asks for one
part, =all for everything; neither moves the others on."""

import os
import subprocess
import sys

PARTS = 8


def asked_part(asked):
    """The part that is asked for; none for everything."""
    if asked == "all":
        return None
    if asked not in map(str, range(1, PARTS + 1)):
        sys.exit(f"STEPWRIGHT_AARCH64_PART is '{asked}': all, or 1 to {PARTS}")
    return int(asked)


def next_part(root, state):
    """The part after the last that passed here; in a new build folder one by the number of commits."""
    if state.exists():
        return int(state.read_text()) % PARTS + 1
    counted = subprocess.run(["git", "-C", str(root), "rev-list", "--count", "HEAD"], capture_output=True, text=True)
    return int(counted.stdout or 0) % PARTS + 1


def part_of_run(root, state):
    """The part of this run; none for everything."""
    asked = os.environ.get("STEPWRIGHT_AARCH64_PART")
    return asked_part(asked) if asked else next_part(root, state)


def note_passed(part, state):
    """The next run takes the next part, unless somebody asked for this one."""
    if part and not os.environ.get("STEPWRIGHT_AARCH64_PART"):
        state.write_text(f"{part}\n")


def tell(part, others):
    """Says which part it is; `others` is what is looked at besides."""
    if part:
        print(f"part {part} of {PARTS}{others}; the same again: STEPWRIGHT_AARCH64_PART={part}", flush=True)
