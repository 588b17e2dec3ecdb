"""Emulator thread that passes bytes between the emulated devices and their clients."""

import select

import numpy as np

from slamlab.devices.clock import Clock
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import EmulatedRobot
from slamlab.devices.emulator.in_memory_emulators import InMemoryEmulators
from slamlab.devices.emulator.lidar_models import lidar_model
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.devices.emulator.pseudo_terminal import PseudoTerminal
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.emulator.serial_line import with_baud_rate
from slamlab.devices.emulator.tcp_server import TcpServer
from slamlab.devices.reader_thread import ReaderThread
from slamlab.devices.shutdown import Closeable, close_at_exit
from slamlab.devices.transport import open_port

POLL_INTERVAL = 0.004  # of the devices [s]
LONGEST_STEP = 0.05  # of the devices' time [s]: they pause while this machine is suspended
LIDAR, EMIR = "lidar", "emir"  # names of the devices


class EmulatorRunner(Closeable):
    """Runs named pairs (device, EmulatorPort); a client gets ``opener`` and ``clock``."""

    opener = staticmethod(open_port)

    def __init__(self, devices):
        self._devices, self.clock = devices, Clock()  # ports need real time
        self.error, self._seen = None, self.clock.now()
        self._now = self._seen
        self._thread = ReaderThread(self._step, "emulator", self._on_end, self.clock)
        self._thread.start()
        close_at_exit(self)  # after its drivers, which are opened later

    @property
    def ports(self):
        """The name of each device's port, by device."""
        return {name: end.name for name, (_, end) in self._devices.items()}

    @property
    def dropped(self):
        """For each device, the number of lost bytes that its client did not read in time."""
        return {name: end.dropped for name, (_, end) in self._devices.items()}

    def __getitem__(self, name):
        return self._devices[name][0]

    def close(self):
        """Stop the thread, which then closes the ports; repeated calls are safe."""
        self._thread.stop()

    def _step(self, stopping):
        files = [file for _, end in self._devices.values() for file in end.files()]
        if files:
            select.select(files, [], [], POLL_INTERVAL)
        else:
            stopping.wait(POLL_INTERVAL)
        now = self.clock.now()
        # after a suspension of this machine, the robot must not drive on for the whole time
        self._now += min(now - self._seen, LONGEST_STEP)
        self._seen = now
        for device, end in self._devices.values():
            received = end.receive()
            try:
                data = with_baud_rate(device, end.baud).feed(received, self._now)
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


def run_emulators(world, rng, tcp=None, lidar=None, emir=None, body=None, clock=None, carrier=None):
    """Run an emulated lidar on an emulated eMIR or a pedestrian, on ports or in memory.

    ``tcp``: (host, lidar's port, eMIR's port), or None for pseudo-terminals; ``lidar``, ``emir``,
    ``body``: options of RPLidarEmulator (``model`` by name), EmirEmulator and EmulatedRobot;
    ``clock``: SimulatedClock to run in memory, or None; ``carrier``: Carrier, instead of a robot.
    Returns an EmulatorRunner or InMemoryEmulators, whose ``body`` is the robot or carrier. Raises
    PortError, ValueError.
    """
    robot = carrier or EmulatedRobot(world, rng, **(body or {}))
    damage = np.random.default_rng(int(rng.integers(2**63)))
    lidar = dict(lidar or {})
    model = lidar_model(lidar.pop("model", "a2m8"))
    measure = MovingLidar(robot, rng, model.scanner)
    machines = {LIDAR: RPLidarEmulator(measure, model, rng=damage, **lidar)}
    if carrier is None:
        machines[EMIR] = EmirEmulator(robot, rng=damage, **(emir or {}))
    if clock is None:
        running = EmulatorRunner(attach_ports(machines, tcp))
    else:
        running = InMemoryEmulators(machines, clock)
    running.body = robot
    return running


def attach_ports(devices, tcp=None):
    """Attach each device to a pseudo-terminal or to a TCP port of (host, *ports).

    Raises PortError.
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
