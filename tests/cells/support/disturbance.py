"""What happens to the scan of a runtime over some seconds, beside what happens to a bare wake-up loop of the same interval
and priority in another process: whether the scan suffers more than the machine itself does."""

import dataclasses
import subprocess
import time

from processes import PATIENCE_S, TESTS


@dataclasses.dataclass
class Stretch:
    seconds: float
    scans: float
    overruns: float
    resident_bytes: float
    traps: float
    bare_cycles: int
    bare_overruns: int

    @property
    def late_share(self):
        return self.overruns / max(1.0, self.scans + self.overruns)

    @property
    def bare_late_share(self):
        return self.bare_overruns / max(1.0, self.bare_cycles + self.bare_overruns)

    def __str__(self):
        return (f"{self.seconds:.1f} s, {self.scans:.0f} scans, {self.overruns:.0f} late or left out, "
                f"{self.bare_overruns} of a bare loop, {self.resident_bytes / 1024:.0f} KiB resident")


def watch(cell, work):
    """Does `work` (which takes some seconds) and says what the scan did meanwhile."""
    key = (("runtime", cell.name),)
    bare = subprocess.Popen([TESTS / "cells_bare"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    try:
        first, began = cell.metrics(), time.monotonic()
        work()
        last, seconds = cell.metrics(), time.monotonic() - began
    finally:
        cycles, overruns = (int(word) for word in bare.communicate(timeout=PATIENCE_S)[0].split())

    def grown(name):
        return last[(name, key)] - first[(name, key)]

    return Stretch(seconds, grown("stepwright_scans_total"), grown("stepwright_scan_overruns_total"),
                   last[("stepwright_resident_memory_bytes", key)], grown("stepwright_traps_total"),
                   cycles, overruns)


def no_worse(test, quiet, abused, factor=3.0, floor=0.01):
    """Generous, as the two loops do not meet the same moments: so many times the share of late cycles that a bare loop
    had in the same seconds, and a floor of one in a hundred."""
    print(f"\n  quiet:  {quiet}\n  abused: {abused}")
    test.assertLessEqual(abused.late_share, abused.bare_late_share * factor + floor)
    test.assertEqual(abused.traps, 0)
    # None was lost without being counted: the scans and those left out make up the time.
    test.assertGreater(abused.scans + abused.overruns, abused.seconds * 1000 * 0.9 - 200)
    test.assertLess(abused.resident_bytes - quiet.resident_bytes, 1 << 20)
