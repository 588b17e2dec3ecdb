"""Synthetic raw recordings: a drive of the emulated devices in simulated time, reproducible."""

import numpy as np

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import commands
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulator_runner import EMIR, LIDAR
from slamlab.devices.emulator.memory_emulators import MemoryEmulators
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.devices.emulator.robot_body import RobotBody
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.recording.recorder import Recorder
from slamlab.devices.rplidar.driver import DEFAULT_PWM
from slamlab.devices.rplidar.session import Session
from slamlab.readings import Trajectory

BAUD_RATES = {LIDAR: 115200, EMIR: 57600}  # [bit/s]
POLL_INTERVAL = 0.01  # how often the ports are read [s]
READ_SIZE = 4096  # bytes a read


def record_synthetic_drive(path, world, rng, course, mode=1):
    """Record a synthetic drive: the bytes of emulated lidar and robot along a course.

    Parameters
    ----------
    path : str or Path, of a file that is not there yet
    world : World
    rng : numpy.random.Generator, of noise and slip
    course : sequence of (seconds, v, omega): how long, speed and turn rate [s, %, %]
    mode : int, the lidar's; 1 express, 2 boost

    Returns
    -------
    Trajectory, where the robot really was, on the recording's clock

    Raises
    ------
    FileExistsError, OSError
    """
    clock, body, times, poses = SimulatedClock(), RobotBody(world, rng), [], []
    lidar = RPLidarEmulator(MovingLidar(body, rng), rng=rng, typical=mode)
    emulators = MemoryEmulators({LIDAR: lidar, EMIR: EmirEmulator(body, rng=rng)}, clock)
    ports = {name: {"port": "emulated", "baud": baud} for name, baud in BAUD_RATES.items()}
    with Recorder(path, ports, clock) as recorder:
        # as the drivers begin, so that they find their answers when it is replayed
        robot = recorder.opener(EMIR, emulators.opener)(EMIR, BAUD_RATES[EMIR])
        robot.write(commands.stop() + commands.info(True))
        lidar_opener = recorder.opener(LIDAR, emulators.opener)
        session = Session(LIDAR, (BAUD_RATES[LIDAR],), lidar_opener, clock)
        _, typical = session.modes()
        session.start_scan(typical, DEFAULT_PWM)
        for seconds, v, omega in course:
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


rehearse = record_synthetic_drive  # name in the first edition
