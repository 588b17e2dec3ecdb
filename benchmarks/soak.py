"""Lidar, robot and SLAM live for minutes, through emulators on real ports: is any scan lost?

Emulators, drivers and SLAM share a process, as in a notebook. A machine that others keep busy is no
fault of theirs: a heart beats beside them, and turns that went by while it did not are told.
"""

import os
import threading
import time
from dataclasses import dataclass

import numpy as np

from benchmarks.common import row
from slamlab import estimators, worlds
from slamlab.devices.emulator.bench import bench
from slamlab.devices.errors import ConnectionLost
from slamlab.devices.rplidar import Lidar
from slamlab.devices.source import devices

TITLE = "devices: live SLAM through emulators on real ports (wall time)"
LOCAL = "127.0.0.1", 0, 0
TURN = 0.1  # [s]
BEAT = 0.01  # [s]
CIRCLE = 0.1, 0.5  # what the robot drives [m/s, rad/s]
PULLS = 10


class Heart:
    """Beats while it lasts; ``stood`` is for how many turns' time it was kept from that."""

    def __enter__(self):
        self.stood, self._stop = 0.0, threading.Event()
        self._thread = threading.Thread(target=self._beat, daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *exc):
        self._stop.set()
        self._thread.join()

    def _beat(self):
        last = time.monotonic()
        while not self._stop.wait(BEAT):
            now = time.monotonic()
            late = now - last - BEAT
            self.stood += late / TURN if late > TURN / 4 else 0  # less does no harm
            last = now


@dataclass
class Soak:
    """What came of it: turns ``made`` and ``dropped``, the largest ``lag`` [turns], turns' time for
    which the machine ``stood`` still, ``bytes`` lost, ``cpu`` share of one core."""

    made: int
    dropped: int
    lag: int
    stood: float
    bytes: int
    cpu: float


def running():
    """The emulators."""
    return bench(worlds.polygon(), np.random.default_rng(0), None if os.name == "posix" else LOCAL)


def soak(seconds, estimator="icp"):
    """Let a robot drive in circles and a SLAM take in every scan.

    Parameters
    ----------
    seconds : float [s]
    estimator : str, its name

    Returns
    -------
    Soak
    """
    with running() as it, devices(",".join(it.ports.values())) as source, Heart() as heart:
        slam, lag = estimators.make(estimator, source), 0
        source.drive(CIRCLE)
        cpu, begin = time.process_time(), time.monotonic()
        for taken, reading in enumerate(source, 1):
            slam.step(reading)
            stats = source.lidar.stats
            lag = max(lag, stats["turns"] - stats["turns dropped"] - taken)
            if reading.time > seconds:
                break
        cpu = (time.process_time() - cpu) / (time.monotonic() - begin)
        lost = stats["bytes dropped"] + sum(it.dropped.values())
    return Soak(stats["turns"], stats["turns dropped"], lag, heart.stood, lost, cpu)


def noticed(fault):
    """How long until a lidar that is gone is noticed [s].

    Parameters
    ----------
    fault : str, "unplugged", or "stalled" where the port stays and nothing comes any more
    """
    with running() as it, Lidar(it.ports["lidar"]) as lidar:
        lidar.turn()
        setattr(it["lidar"].faults, fault, True)
        begin = time.monotonic()
        try:
            while lidar.turn():
                pass
        except ConnectionLost:
            pass
        return time.monotonic() - begin


def run(quick):
    """Rows on ten minutes of live SLAM, and on lidars that go."""
    came = soak(20 if quick else 600)
    pulls = 2 if quick else 10
    gone = {fault: max(noticed(fault) for _ in range(pulls)) for fault in ("unplugged", "stalled")}
    return [
        row(f"turns dropped of {came.made}", came.dropped, "1", "goal 0", came.dropped == 0),
        row("turns by which the SLAM lags, at most", came.lag, "1", "goal 1", 1 / max(came.lag, 1)),
        row("turns' time the machine stood", came.stood, "1", "goal 0", came.stood == 0),
        row("bytes lost", came.bytes, "1", "goal 0", came.bytes == 0),
        row("all together: share of a core", 100 * came.cpu, "%", "one core", 1 / came.cpu),
        *(
            row(f"lidar {fault} → noticed, at most", seconds, "s", "goal 1 s", 1 / seconds)
            for fault, seconds in gone.items()
        ),
    ]
