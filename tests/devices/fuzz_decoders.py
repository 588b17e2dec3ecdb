"""Fuzz test of the decoders, random and damaged bytes: ``python -m tests.devices.fuzz_decoders``.

By hand, for it takes minutes; the tests do the same with 10⁵. Each decoder gets so many random
bytes, then so many of a good stream damaged in bursts; after each a good turn must bring it back.
"""

import argparse
import sys
import time

import numpy as np

from slamlab.devices.emir.commands import move
from slamlab.devices.emir.frames import COMMAND, STATUS, Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.rplidar.response_finder import ResponseFinder
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_stream import DECODERS
from tests.devices.byte_streams import ANSWERS, damaged, pieces, stream, turn_bytes

BURST = 20_000  # bytes
KEPT = 200  # bytes that may wait in a decoder
HURTS = (
    {"flips": 0.001},
    {"flips": 0.1},
    {"losses": 0.01},
    {"additions": 0.01},
    {"flips": 0.3, "losses": 0.3, "additions": 0.3},
)


def cut(data, rng):
    """Data in pieces of 1 to 4096 bytes."""
    return pieces(data, rng.permutation(np.unique(np.geomspace(1, 4096, 40).astype(int))))


def random_bytes(make, count, rng, kept):
    """Feed random bytes; the largest number that waited."""
    machine, most = make(), 0
    for _ in range(0, count, BURST):
        for piece in cut(rng.bytes(BURST), rng):
            machine.feed(piece)
            most = max(most, kept(machine))
    return most


def damaged_scans(answer, count, rng):
    """Feed damaged bytes and two good turns, again and again; (most that waited, failures)."""
    decoder, most, failures = DECODERS[answer](), 0, 0
    good = stream(answer, 20_000)
    turn, size = turn_bytes(answer), DECODERS[answer].size
    for k, _ in enumerate(range(0, count, BURST)):
        at = int(rng.integers(0, max(len(good) - BURST, 1)))
        for piece in cut(damaged(good[at : at + BURST], rng, **HURTS[k % len(HURTS)]), rng):
            decoder.feed(piece)
            most = max(most, decoder.pending)
        begin = int(rng.integers(0, len(good) // size - 3 * turn // size)) * size
        tail = good[begin : begin + 2 * turn // size * size]
        nodes = np.concatenate([decoder.feed(piece) for piece in cut(tail, rng)])
        expected = DECODERS[answer]().feed(tail)
        n = len(expected) // 2
        names = ["angle_q6", "distance_q2", "quality", "start"]
        failures += not np.array_equal(nodes[-n:][names], expected[-n:][names])
    return most, failures


def damaged_frames(mark, count, rng):
    """The same with eMIR's frames."""
    framer, most, failures = Framer(mark), 0, 0
    frame = Status(path=-3, angle=7).pack() if mark == STATUS else move(20, -30)
    content = bytes.fromhex(frame[1:-3].decode())
    for k, _ in enumerate(range(0, count, BURST)):
        for piece in cut(damaged(frame * (BURST // len(frame)), rng, **HURTS[k % 5]), rng):
            framer.feed(piece)
            most = max(most, len(framer._buffer))
        failures += framer.feed(frame * 3)[-2:] != [content] * 2
    return most, failures


def main(argv=None):
    """Run; 0 where nothing failed."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.devices.fuzz_decoders", description=__doc__
    )
    parser.add_argument("--bytes", type=int, default=10_000_000, metavar="N", help="of each kind")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(argv)
    rng, failed = np.random.default_rng(options.seed), 0
    for answer, decoder in DECODERS.items():
        begin = time.process_time()
        most, failures = random_bytes(decoder, options.bytes, rng, lambda d: d.pending), 0
        if answer in ANSWERS:
            other, failures = damaged_scans(answer, options.bytes, rng)
            most = max(most, other)
        failed += failures or most > KEPT
        report(decoder.__name__, most, failures, begin)
    for mark in (STATUS, COMMAND):
        begin = time.process_time()
        most = random_bytes(lambda m=mark: Framer(m), options.bytes, rng, lambda f: len(f._buffer))
        other, failures = damaged_frames(mark, options.bytes, rng)
        failed += failures or max(most, other) > KEPT
        report(f"Framer {mark.decode()}", max(most, other), failures, begin)
    begin = time.process_time()
    finder = lambda: ResponseFinder(AnswerType.INFO, length=20)  # noqa: E731
    most = random_bytes(finder, options.bytes // 10, rng, lambda f: len(f._buffer))
    report("ResponseFinder", most, 0, begin)
    return int(bool(failed))


def report(name, most, failures, begin):
    """One line of the result."""
    spent = time.process_time() - begin
    print(
        f"{name:16} kept {most:4d} bytes at most, {failures} times not back in step, {spent:.0f} s"
    )


if __name__ == "__main__":
    sys.exit(main())
