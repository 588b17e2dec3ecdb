"""How long tests wait for what must come: a guard against hanging, never a measure of speed."""

import time

PATIENCE = 300  # [s]; what is there is not waited for


def until(said):
    """Wait until something is true."""
    end = time.monotonic() + PATIENCE
    while not said():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.01)
