"""Synthetic raw recordings of emulated devices; simulated time makes them reproducible."""

import numpy as np

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import commands
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import EmulatedRobot
from slamlab.devices.emulator.emulator_runner import EMIR, LIDAR
from slamlab.devices.emulator.in_memory_emulators import InMemoryEmulators
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.recording.recorder import Recorder
from slamlab.devices.recording.recording_file import BAUD_RATES
from slamlab.devices.rplidar.driver import DEFAULT_PWM
from slamlab.devices.rplidar.session import Session
from slamlab.readings import Trajectory

POLL_INTERVAL = 0.01  # between reads of the ports [s]
READ_SIZE = 4096  # bytes a read


def record_synthetic_run(path, world, rng, motions, mode=1):
    """Record an emulated lidar on an emulated robot in a world, and write a new recording file.

    ``motions``: rows (seconds, v, omega) [s, %, %]; ``mode``: scan mode, 1 express, 2 boost.
    Returns the true Trajectory on the recording's clock. Raises FileExistsError, OSError.
    """
    clock, body, times, poses = SimulatedClock(), EmulatedRobot(world, rng), [], []
    lidar = RPLidarEmulator(MovingLidar(body, rng), rng=rng, typical=mode)
    emulators = InMemoryEmulators({LIDAR: lidar, EMIR: EmirEmulator(body, rng=rng)}, clock)
    ports = {name: {"port": "emulated", "baud": baud} for name, baud in BAUD_RATES.items()}
    with Recorder(path, ports, clock) as recorder:
        # the same requests as of the drivers, so that the playback can answer them
        robot = recorder.opener(EMIR, emulators.opener)(EMIR, BAUD_RATES[EMIR])
        robot.write(commands.stop() + commands.info(True))
        lidar_opener = recorder.opener(LIDAR, emulators.opener)
        session = Session(LIDAR, BAUD_RATES[LIDAR], lidar_opener, clock)
        _, typical = session.modes()
        session.start_scan(typical, DEFAULT_PWM)
        for seconds, v, omega in motions:
            robot.write(commands.move(v, omega))
            for _ in range(round(seconds / POLL_INTERVAL)):
                clock.sleep(POLL_INTERVAL)
                for port in (session.link.port, robot):
                    port.read(READ_SIZE, 0)
                times.append(clock.now())
                poses.append(body.pose)
        robot.write(commands.move(0, 0))
        session.close()
        robot.close()
    return Trajectory(np.array(times), np.array(poses))
