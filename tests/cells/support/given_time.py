"""A clock that goes on only while the machine gives threads their turn: what a bound of the product's own time is held
against, so that it holds on a busy machine, too (tests/support/given_time.h)."""

import threading
import time

STEP_S = 0.001


class GivenTime:
    """Never ahead of the wall's clock. Use: with GivenTime() as given: ...; given.seconds()."""

    def __init__(self):
        self.rounds = 0
        self.ends = threading.Event()
        self.thread = threading.Thread(target=self._count, daemon=True)

    def _count(self):
        while not self.ends.is_set():
            time.sleep(STEP_S)
            self.rounds += 1

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.ends.set()
        self.thread.join()

    def seconds(self):
        return self.rounds * STEP_S
