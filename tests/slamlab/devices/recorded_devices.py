"""A lidar and a robot, recorded for some seconds of simulated time."""

import numpy as np

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import commands
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import EmulatedRobot
from slamlab.devices.emulator.in_memory_emulators import InMemoryPort
from slamlab.devices.recording import Recorder
from slamlab.devices.rplidar.requests import Command, Conf, conf, express, motor_pwm, request
from slamlab.simulation import worlds
from tests.slamlab.devices.emulator_helpers import machine

SCANS = {
    "standard": request(Command.SCAN),
    "express": express(1),
    "boost": express(2),
    "legacy": express(0),
}


def listen(port, seconds, clock):
    end = clock.now() + seconds
    while clock.now() < end:
        port.read(4096, 0.02)


def record(path, mode):
    clock = SimulatedClock(50.0)
    body = EmulatedRobot(worlds.room(), np.random.default_rng(0))
    devices = {"lidar": machine(), "emir": EmirEmulator(body)}
    known = {"lidar": {"port": "memory", "baud": 115200}, "emir": {"port": "memory"}}
    with Recorder(path, known, clock) as recorder:
        ports = {
            name: recorder.opener(name, lambda n, b, d=device: InMemoryPort(d, clock, n, b))(
                name, 1
            )
            for name, device in devices.items()
        }
        ports["emir"].write(commands.info(True) + commands.move(40, 20))
        listen(ports["emir"], 0.3, clock)
        asked = [request(Command.GET_INFO), request(Command.GET_HEALTH), conf(Conf.TYPICAL_MODE)]
        asked += [conf(Conf.MODE_COUNT)]
        of_mode = Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE, Conf.ANSWER_TYPE, Conf.NAME
        asked += [conf(what, k) for k in range(3) for what in of_mode]
        for data in asked:
            ports["lidar"].write(data)
            listen(ports["lidar"], 0.05, clock)
        ports["lidar"].write(motor_pwm(660) + SCANS[mode])
        for _ in range(40):
            listen(ports["lidar"], 0.05, clock)
            listen(ports["emir"], 0.005, clock)
        ports["lidar"].write(request(Command.STOP))
        listen(ports["lidar"], 0.1, clock)
    return path
