"""How long tests wait for what must come: a guard against hanging, never a measure of speed."""

import time

PATIENCE = float(__import__("os").environ.get("P", 300))


def until(said):
    """Wait until something is true."""
    end = time.monotonic() + PATIENCE
    while not said():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.01)
