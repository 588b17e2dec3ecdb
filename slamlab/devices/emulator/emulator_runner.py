"""Emulator runner: a thread that passes bytes between emulated devices and their clients."""

import select

import numpy as np

from slamlab.devices.clock import Clock
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.memory_emulators import MemoryEmulators
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.devices.emulator.pseudo_terminal import PseudoTerminal
from slamlab.devices.emulator.robot_body import RobotBody
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.emulator.tcp_server import TcpServer
from slamlab.devices.reader_thread import ReaderThread
from slamlab.devices.shutdown import close_at_exit
from slamlab.devices.transport import open_port

POLL_INTERVAL = 0.004  # between two polls of the devices [s]
LONGEST_STEP = 0.05  # of the devices' time [s]: while the machine stands still, so do they
LIDAR, EMIR = "lidar", "emir"  # names of the devices


class EmulatorRunner:
    """Runs emulated devices, each on a port of its own, in a thread; closes them at its end.

    Parameters
    ----------
    devices : dict of (device with feed(bytes, now) -> bytes, EmulatorPort) by name

    ``clock`` and ``opener`` are what clients are to open the ports with.
    """

    opener = staticmethod(open_port)

    def __init__(self, devices):
        self._devices, self.clock = devices, Clock()  # ports know real time alone
        self.error, self._seen = None, self.clock.now()
        self._now = self._seen
        self._thread = ReaderThread(self._step, "emulator", self._on_end, self.clock)
        self._thread.start()
        close_at_exit(self)  # after the drivers that hang on it: they were opened later

    @property
    def ports(self):
        """Port names that clients open: dict by device."""
        return {name: end.name for name, (_, end) in self._devices.items()}

    @property
    def dropped(self):
        """Bytes lost by overflow since clients did not read: dict by device."""
        return {name: end.dropped for name, (_, end) in self._devices.items()}

    def __getitem__(self, name):
        """Emulated device of a name."""
        return self._devices[name][0]

    def close(self):
        """Stop the emulators, whose ports close with their thread; may be called again."""
        self._thread.stop()

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    def _step(self, stopping):
        files = [file for _, end in self._devices.values() for file in end.files()]
        if files:
            select.select(files, [], [], POLL_INTERVAL)
        else:
            stopping.wait(POLL_INTERVAL)
        now = self.clock.now()
        # a robot would else have driven on for all the time that nobody could look or stop it
        self._now += min(now - self._seen, LONGEST_STEP)
        self._seen = now
        for device, end in self._devices.values():
            received = end.receive()
            try:
                data = device.feed(received, self._now)
            except OSError:  # unplugged
                end.unplug()
                continue
            if not end.plugged:
                end.plug()
            end.send(data)

    def _on_end(self, error):
        self.error = error
        for _, end in self._devices.values():
            end.close()


def run_emulators(world, rng, tcp=None, lidar=None, emir=None, body=None, clock=None):
    """Run an emulated lidar and an eMIR that carries it, in a world, on ports or in memory.

    Parameters
    ----------
    world : World
    rng : numpy.random.Generator
    tcp : (host, lidar's port, eMIR's port) to listen on, or None for pseudo-terminals
    lidar, emir, body : dict or None, options of RPLidarEmulator, EmirEmulator, RobotBody
    clock : SimulatedClock in whose time they run, in memory; None for real time, on ports

    Returns
    -------
    EmulatorRunner or MemoryEmulators with devices "lidar" and "emir"; its ``body`` is the robot

    Raises
    ------
    PortError
    """
    robot = RobotBody(world, rng, **(body or {}))
    damage = np.random.default_rng(int(rng.integers(2**63)))
    machines = {
        LIDAR: RPLidarEmulator(MovingLidar(robot, rng), rng=damage, **(lidar or {})),
        EMIR: EmirEmulator(robot, rng=damage, **(emir or {})),
    }
    if clock is None:
        running = EmulatorRunner(attach_ports(machines, tcp))
    else:
        running = MemoryEmulators(machines, clock)
    running.body = robot
    return running


def attach_ports(devices, tcp=None):
    """Attach each device to a port of its own: a pseudo-terminal or a TCP server.

    Parameters
    ----------
    devices : dict by name
    tcp : (host, a port each) to listen on, or None for pseudo-terminals

    Returns
    -------
    dict of (device, EmulatorPort) by name

    Raises
    ------
    PortError
    """
    pairs = {}
    host, *ports = tcp or (None, *[None] * len(devices))
    try:
        for (name, device), port in zip(devices.items(), ports, strict=False):
            pairs[name] = device, PseudoTerminal(name) if tcp is None else TcpServer(host, port)
    except BaseException:
        for _, end in pairs.values():
            end.close()
        raise
    return pairs
