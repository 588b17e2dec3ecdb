"""Soak test of live SLAM through emulators on real ports: dropped scans, lag, disconnection.

Emulators, drivers and SLAM share a process, as in a notebook. A heartbeat thread measures and
reports for how many turns other programs kept the machine busy.
"""

import os
import threading
import time
from dataclasses import dataclass

import numpy as np

from benchmarks.common import row
from slamlab import estimators
from slamlab.devices.emulator.emulator_runner import run_emulators
from slamlab.devices.errors import ConnectionLost
from slamlab.devices.rplidar import RPLidar
from slamlab.simulation import worlds
from slamlab.sources.live_devices import devices

TITLE = "devices: live SLAM through emulators on real ports (wall time)"
LOCAL = "127.0.0.1", 0, 0
TURN = 0.1  # of the lidar, a revolution [s]
BEAT = 0.01  # period of the heartbeat [s]
CIRCLE = 0.1, 0.5  # command that the robot drives [m/s, rad/s]


class Heartbeat:
    """Heartbeat thread; ``stalled`` is the time for which the machine delayed the thread
    [turns]."""

    def __enter__(self):
        self.stalled, self._stop = 0.0, threading.Event()
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
            self.stalled += late / TURN if late > TURN / 4 else 0  # shorter delays are harmless
            last = now


@dataclass
class Soak:
    """Result of a soak test: turns ``made`` and ``dropped``, largest ``lag`` [turns], time for
    which the machine ``stalled`` [turns], ``bytes`` lost, ``cpu`` share of one core."""

    made: int
    dropped: int
    lag: int
    stalled: float
    bytes: int
    cpu: float


def emulators():
    """Start the emulators of the lidar and the robot."""
    tcp = None if os.name == "posix" else LOCAL
    return run_emulators(worlds.polygon(), np.random.default_rng(0), tcp)


def soak(seconds, estimator="icp"):
    """Run a soak test: a robot drives in circles while SLAM processes every scan.

    Parameters
    ----------
    seconds : float [s]
    estimator : str, its name

    Returns
    -------
    Soak
    """
    with emulators() as it, devices(",".join(it.ports.values())) as source, Heartbeat() as heart:
        slam, lag = estimators.make(estimator, source), 0
        source.drive(CIRCLE)
        cpu, begin = time.process_time(), time.monotonic()
        for taken, reading in enumerate(source, 1):
            slam.step(reading)
            stats = source.lidar.stats
            lag = max(lag, stats["revolutions"] - stats["revolutions dropped"] - taken)
            if reading.time > seconds:
                break
        cpu = (time.process_time() - cpu) / (time.monotonic() - begin)
        lost = stats["bytes dropped"] + sum(it.dropped.values())
    return Soak(stats["revolutions"], stats["revolutions dropped"], lag, heart.stalled, lost, cpu)


def detection_time(fault):
    """Measure the time until a lost connection to the lidar is detected [s].

    Parameters
    ----------
    fault : str, "unplugged", or "stalled" if the port stays open and no data arrive
    """
    with emulators() as it, RPLidar(it.ports["lidar"]) as lidar:
        lidar.revolution()
        setattr(it["lidar"].faults, fault, True)
        begin = time.monotonic()
        try:
            while lidar.revolution():
                pass
        except ConnectionLost:
            pass
        return time.monotonic() - begin


def run(quick):
    """Make rows for ten minutes of live SLAM, and for lost connections to the lidar."""
    got = soak(20 if quick else 600)
    pulls = 2 if quick else 10
    faults = "unplugged", "stalled"
    gone = {fault: max(detection_time(fault) for _ in range(pulls)) for fault in faults}
    return [
        row(f"turns dropped of {got.made}", got.dropped, "1", "goal 0", got.dropped == 0),
        row("lag of the SLAM in turns, at most", got.lag, "1", "goal 1", 1 / max(got.lag, 1)),
        row("time the machine stalled, in turns", got.stalled, "1", "goal 0", got.stalled == 0),
        row("bytes lost", got.bytes, "1", "goal 0", got.bytes == 0),
        row("share of a core in total", 100 * got.cpu, "%", "one core", 1 / got.cpu),
        *(
            row(f"lidar {fault} → detected, at most", seconds, "s", "goal 1 s", 1 / seconds)
            for fault, seconds in gone.items()
        ),
    ]
