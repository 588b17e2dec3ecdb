"""Timeouts of tests: they guard against hanging and do not measure speed."""

import time

PATIENCE = 300  # [s]; a wait ends as soon as its condition holds


def until(condition):
    """Wait until something is true."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.01)
