"""Cost of decoding one second of device data, and ten minutes of live SLAM through ports."""

import sys

import numpy as np

from benchmarks import soak
from benchmarks.common import cpu_times, main, row
from slamlab.devices.emir.frames import Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emulator.packet_encoder import ENCODERS
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_modes import ScanMode
from slamlab.devices.rplidar.scan_stream import ScanStream

TITLE = "devices: decoding one second of data (CPU time, one thread, methods taking turns)"
BAUD = 115200
READ = 0.01  # period of reading: an adapter delivers bytes every 1 to 16 ms [s]
LIMITS = {AnswerType.SCAN: 1.0, AnswerType.EXPRESS: 3.0, AnswerType.ULTRA: 3.0}  # of a core [%]
MODES = (
    ScanMode(0, "SCAN", 508e-6, 12.0, AnswerType.SCAN),
    ScanMode(1, "EXPRESS", 254e-6, 12.0, AnswerType.EXPRESS),
    ScanMode(2, "ultra", 127e-6, 12.0, AnswerType.ULTRA),
)
STATUS_RATE = 10  # eMIR's status frames a second


def room(directions):
    """Simulate distances of a room, with edges, missing ranges and noise [mm]."""
    rng = np.random.default_rng(0)
    walls = 1500 / np.maximum(np.abs(np.cos(np.radians(directions))), 0.3)
    walls[rng.random(len(walls)) < 0.05] = 0
    return walls * (1 + 0.003 * rng.standard_normal(len(walls)))


def second(mode):
    """Return one second of bytes in a scan mode, in chunks as they are read."""
    packer, size, ahead = ENCODERS[mode.answer_type]
    step, packets = 3600 * mode.period, []
    for at in range(0, int(1 / mode.period), size):
        packets += packer(step * np.arange(at, at + size + ahead), step, room, at == 0)
    data = b"".join(packets)
    n = int(len(data) * READ)
    return [data[at : at + n] for at in range(0, len(data), n)]


def decode(mode, pieces):
    """Return a function that decodes one second of bytes to scans; each call continues the
    stream."""
    stream, now = ScanStream(mode.answer_type, mode.period, BAUD, 0.0), 0.0

    def one_second():
        nonlocal now
        turns = 0
        for piece in pieces:
            now += READ
            turns += len(stream.feed(piece, now))
        return turns

    return one_second


def frames():
    """Return a function that decodes one second of eMIR status frames."""
    framer, data = Framer(), Status(path=3, angle=-7).pack()
    return lambda: [Status.unpack(f) for _ in range(STATUS_RATE) for f in framer.feed(data)]


def run(quick):
    """Make rows with the share of a core and its ratio to the limit."""
    methods = {mode.answer_type: decode(mode, second(mode)) for mode in MODES}
    for mode in MODES:
        turns = sum(methods[mode.answer_type]() for _ in range(3))
        if not 25 <= turns <= 31:
            raise AssertionError(f"{mode.name}: {turns} turns in three seconds, not about 30")
    times = cpu_times({**methods, "eMIR": frames()}, quick)
    rows = [
        row(f"{m.name}: share of a core", 100 * share, "%", f"limit {limit} %", limit / 100 / share)
        for m in MODES
        for share, limit in [(times[m.answer_type], LIMITS[m.answer_type])]
    ]  # fmt: skip
    share = 100 * times["eMIR"]
    return [*rows, row("eMIR: share of a core", share, "%", "limit 1.0 %", 1.0 / share)]


if __name__ == "__main__":
    sys.exit(main({TITLE: run, soak.TITLE: soak.run}, "python -m benchmarks.devices"))
