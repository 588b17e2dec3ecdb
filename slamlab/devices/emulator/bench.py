"""Emulated devices that run: a thread passes bytes between them and their clients."""

import select

import numpy as np

from slamlab.devices.clock import Clock
from slamlab.devices.closing import closed_at_exit
from slamlab.devices.emulator.body import Body
from slamlab.devices.emulator.emir import EmirMachine
from slamlab.devices.emulator.ends import PtyEnd
from slamlab.devices.emulator.rplidar import RplidarMachine
from slamlab.devices.emulator.sight import Sight
from slamlab.devices.emulator.tcpend import TcpEnd
from slamlab.devices.reader import Reader

GRAIN = 0.004  # how often devices are asked when nobody writes to them [s]
LIDAR, EMIR = "lidar", "emir"


class Bench:
    """Devices with a wire each; closes them at its end.

    Parameters
    ----------
    devices : dict of (device with feed(bytes, now) -> bytes, End) by name
    clock : Clock
    """

    def __init__(self, devices, clock=None):
        self._devices, self._clock = devices, clock or Clock()
        self.error = None
        self._thread = Reader(self._step, "emulator", self._ended)
        self._thread.start()
        closed_at_exit(self)  # after the drivers that hang on it: they were opened later

    @property
    def ports(self):
        """dict of what clients open, by name."""
        return {name: end.name for name, (_, end) in self._devices.items()}

    @property
    def dropped(self):
        """dict of bytes that clients did not read in time, by name."""
        return {name: end.dropped for name, (_, end) in self._devices.items()}

    def __getitem__(self, name):
        """The device of a name."""
        return self._devices[name][0]

    def close(self):
        """Stop it, pull every plug; may be called again."""
        self._thread.stop()
        for _, end in self._devices.values():
            end.close()

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    def _step(self, stopping):
        files = [file for _, end in self._devices.values() for file in end.files()]
        if files:
            select.select(files, [], [], GRAIN)
        else:
            stopping.wait(GRAIN)
        for device, end in self._devices.values():
            received = end.receive()
            try:
                data = device.feed(received, self._clock.now())
            except OSError:  # unplugged
                end.unplug()
                continue
            if not end.plugged:
                end.plug()
            end.send(data)

    def _ended(self, error):
        self.error = error


def bench(world, rng, tcp=None, lidar=None, emir=None, body=None):
    """A lidar and an eMIR that carries it, in a world.

    Parameters
    ----------
    world : World
    rng : numpy.random.Generator
    tcp : (host, lidar's port, eMIR's port) to listen on, or None for pseudo-terminals
    lidar, emir, body : dict or None, options of RplidarMachine, EmirMachine, Body

    Returns
    -------
    Bench with devices "lidar" and "emir"; its ``body`` is the robot

    Raises
    ------
    PortError
    """
    robot = Body(world, rng, **(body or {}))
    damage = np.random.default_rng(int(rng.integers(2**63)))
    machines = {
        LIDAR: RplidarMachine(Sight(robot, rng), rng=damage, **(lidar or {})),
        EMIR: EmirMachine(robot, rng=damage, **(emir or {})),
    }
    running = Bench(wired(machines, tcp))
    running.body = robot
    return running


def wired(devices, tcp=None):
    """Give each device an end of its own.

    Parameters
    ----------
    devices : dict by name
    tcp : (host, a port each) to listen on, or None for pseudo-terminals

    Returns
    -------
    dict of (device, End) by name

    Raises
    ------
    PortError
    """
    pairs = {}
    host, *ports = tcp or (None, *[None] * len(devices))
    try:
        for (name, device), port in zip(devices.items(), ports, strict=False):
            pairs[name] = device, PtyEnd(name) if tcp is None else TcpEnd(host, port)
    except BaseException:
        for _, end in pairs.values():
            end.close()
        raise
    return pairs
