"""Fuzz the wire protocol: ``python -m tests.classroom.grading.fuzz 1000000`` (damaged frames)."""

import io
import sys

import numpy as np

from classroom.grading import wire_protocol

WHOLE = wire_protocol.pack({"turn": 3, "problem": "x"}, {"r": np.arange(4.0), "b": [True, False]})
HOT = b'{}[]",:0123456789-.eE\\u\x00\xff fib'


def damaged(count, seed):
    """Frames with some bytes changed, some with their end cut off.

    Parameters
    ----------
    count, seed : int

    Yields
    ------
    bytes
    """
    rng = np.random.default_rng(seed)
    for _ in range(count):
        data = bytearray(WHOLE)
        for position in rng.integers(0, len(data), rng.integers(1, 5)):
            data[position] = (
                HOT[rng.integers(len(HOT))] if rng.random() < 0.7 else rng.integers(256)
            )
        if rng.random() < 0.2:
            del data[rng.integers(len(data)) :]
        yield bytes(data)


def rejected_or_plain(data):
    """Whether some bytes are a frame; anything but a clean rejection or plain data is an error."""
    try:
        got = wire_protocol.receive(io.BytesIO(data))
    except wire_protocol.WireError:
        return False
    if got is not None:
        head, arrays = got
        assert isinstance(head, dict)
        assert all(array.dtype.kind in "fib" for array in arrays.values())
    return got is not None


if __name__ == "__main__":
    most = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    frames = sum(rejected_or_plain(data) for data in damaged(most, seed=9))
    print(f"{most} damaged frames: {most - frames} rejected cleanly, {frames} still frames")
