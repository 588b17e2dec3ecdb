"""A drive of the emulated devices recorded in simulated time: at once, the same bytes always."""

import numpy as np

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import commands
from slamlab.devices.emulator.bench import EMIR, LIDAR
from slamlab.devices.emulator.body import Body
from slamlab.devices.emulator.emir import EmirMachine
from slamlab.devices.emulator.rplidar import RplidarMachine
from slamlab.devices.emulator.sight import Sight
from slamlab.devices.memory import MemoryPort
from slamlab.devices.recording.recorder import Recorder
from slamlab.devices.rplidar.lidar import PWM
from slamlab.devices.rplidar.session import Session
from slamlab.readings import Trajectory

BAUDS = {LIDAR: 115200, EMIR: 57600}
GRAIN = 0.01  # how often the ports are read [s]
MOST = 4096  # bytes a read


def rehearse(path, world, rng, course, mode=1):
    """Record what lidar and robot send while the robot is driven along a course.

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
    clock, body, times, poses = SimulatedClock(), Body(world, rng), [], []
    lidar = RplidarMachine(Sight(body, rng), rng=rng, typical=mode)
    machines = {LIDAR: lidar, EMIR: EmirMachine(body, rng=rng)}

    def opened(name, baud):
        return MemoryPort(machines[name], clock, name, baud)

    known = {name: {"port": "emulated", "baud": baud} for name, baud in BAUDS.items()}
    with Recorder(path, known, clock) as recorder:
        # as the drivers begin, so that they find their answers when it is replayed
        robot = recorder.opener(EMIR, opened)(EMIR, BAUDS[EMIR])
        robot.write(commands.stop() + commands.info(True))
        session = Session(LIDAR, (BAUDS[LIDAR],), recorder.opener(LIDAR, opened), clock)
        _, typical = session.modes()
        session.begin(typical, PWM)
        for seconds, v, omega in course:
            robot.write(commands.move(v, omega))
            for _ in range(round(seconds / GRAIN)):
                clock.sleep(GRAIN)
                for port in (session.link.port, robot):
                    port.read(MOST, 0)
                times.append(clock.now())
                poses.append(body.pose)
        robot.write(commands.move(0, 0))
        session.let_go()
        robot.close()
    return Trajectory(np.array(times), np.array(poses))
