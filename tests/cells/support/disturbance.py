"""What happens to the scan of a runtime over some seconds, and whether it is worse than when nothing is done to it."""

import dataclasses
import time


@dataclasses.dataclass
class Stretch:
    seconds: float
    scans: float
    overruns: float
    resident_bytes: float
    traps: float

    @property
    def late_share(self):
        return self.overruns / max(1.0, self.scans + self.overruns)

    def __str__(self):
        return (f"{self.seconds:.1f} s, {self.scans:.0f} scans, {self.overruns:.0f} late or left out, "
                f"{self.resident_bytes / 1024:.0f} KiB resident")


def watch(cell, work):
    """Does `work` (which takes some seconds) and says what the scan did meanwhile."""
    key = (("runtime", cell.name),)
    first, began = cell.metrics(), time.monotonic()
    work()
    last, seconds = cell.metrics(), time.monotonic() - began

    def grown(name):
        return last[(name, key)] - first[(name, key)]

    return Stretch(seconds, grown("stepwright_scans_total"), grown("stepwright_scan_overruns_total"),
                   last[("stepwright_resident_memory_bytes", key)], grown("stepwright_traps_total"))


def no_worse(test, quiet, abused, factor=5.0, floor=0.02):
    """Generous, as the machine has other work too: so many times the share of late scans of the quiet stretch, and a
    floor of two in a hundred."""
    print(f"\n  quiet:  {quiet}\n  abused: {abused}")
    test.assertLessEqual(abused.late_share, quiet.late_share * factor + floor)
    test.assertEqual(abused.traps, 0)
    # None was lost without being counted: the scans and those left out make up the time.
    test.assertGreater(abused.scans + abused.overruns, abused.seconds * 1000 * 0.9 - 200)
    test.assertLess(abused.resident_bytes - quiet.resident_bytes, 1 << 20)
