"""The emulated RPLIDAR answers as the real one: requests, timing, bandwidth, motor, faults."""

import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.devices.emulator.rplidar_emulator import BANNER
from slamlab.devices.emulator.serial_line import Faults
from slamlab.devices.rplidar.requests import Command, Conf, conf, express, motor_pwm, request
from slamlab.devices.rplidar.responses import AnswerType, Health, Info
from tests.slamlab.devices.emulator_helpers import answers, machine, nodes, receive

INFO, HEALTH, STOP = (request(Command[c]) for c in ("GET_INFO", "GET_HEALTH", "STOP"))
SCAN, FORCE, RESET = (request(Command[c]) for c in ("SCAN", "FORCE_SCAN", "RESET"))
ACC = request(Command.GET_ACC_BOARD_FLAG, bytes(4))
SAMPLES = {SCAN: 1e6 / 508, express(1): 1e6 / 254, express(2): 1e6 / 127}


def test_several_requests_in_one_read_are_all_answered_in_their_order():
    data = INFO + HEALTH + request(Command.GET_SAMPLERATE) + ACC
    found = answers(receive(machine(health=(1, 0x0201)), data, 5.0, 0.1))
    kinds = [AnswerType(kind).name for kind, _ in found]
    assert kinds == ["INFO", "HEALTH", "SAMPLERATE", "ACC_BOARD_FLAG"]
    info = Info.unpack(found[0][1])
    assert (info.model, info.firmware, info.hardware) == (0x28, (1, 29), 5)
    assert Health.unpack(found[1][1]) == Health(1, 0x0201)


@given(st.lists(st.integers(1, 7), max_size=40), st.binary(max_size=20))
def test_requests_are_parsed_in_any_chunks_after_any_bytes(cuts, before):
    before = before.replace(b"\xa5", b"")
    data, lidar, t, at = before + conf(Conf.MODE_COUNT) + INFO + motor_pwm(0), machine(), 1.0, 0
    for cut in [*cuts, len(data)]:
        lidar.feed(data[at : at + cut], t)
        at, t = at + cut, t + 0.01
    assert [command for command, _ in lidar.requests] == [
        Command.GET_LIDAR_CONF,
        Command.GET_INFO,
        Command.SET_MOTOR_PWM,
    ]


def test_half_a_request_is_forgotten_after_five_seconds():
    lidar = machine()
    lidar.feed(b"\xa5\x82", 1.0)
    assert lidar.feed(INFO, 5.9) == b"" and not lidar.requests
    assert answers(receive(lidar, b"", 5.9, 0.2)) == []
    lidar = machine()
    lidar.feed(b"\xa5\x82", 1.0)
    assert [kind for kind, _ in answers(receive(lidar, INFO, 6.1, 0.2))] == [AnswerType.INFO]


def test_a_request_with_a_wrong_checksum_is_no_request():
    wrong = bytearray(motor_pwm(0))
    wrong[-1] ^= 1
    lidar = machine()
    assert answers(receive(lidar, bytes(wrong) + INFO, 0.0, 0.1))[0][0] == AnswerType.INFO
    assert lidar.motor.pwm == 660 and len(lidar.requests) == 1


def test_an_unknown_configuration_is_never_answered_with_an_empty_value():
    rotation = answers(receive(machine(), conf(Conf.DESIRED_ROTATION), 20.0, 0.1))[0][1]
    assert struct.unpack("<IHH", rotation) == (1, 600, 660)
    assert receive(machine(), conf(Conf.NAME, 3) + conf(0x99), 30.0, 0.1) == b""


def test_old_firmware_is_silent_about_its_configuration_and_older_one_has_no_express():
    old, older = machine(firmware=(1, 20)), machine(firmware=(1, 10))
    for lidar in (old, older):
        assert receive(lidar, conf(Conf.MODE_COUNT) + conf(Conf.DESIRED_ROTATION), 0.0, 0.2) == b""
    assert receive(old, express(0), 1.0, 0.1)[:7].hex() == "a55a5400004082"
    assert receive(older, express(0) + request(Command.GET_SAMPLERATE), 1.0, 0.3) == b""


@pytest.mark.parametrize("asked", SAMPLES)
def test_no_more_bytes_come_than_the_line_can_carry(asked):
    lidar, t, sent = machine(), 0.0, 0
    lidar.feed(asked, t)
    for _ in range(1000):
        t += 0.0007
        sent += len(lidar.feed(b"", t))
        assert sent <= 11520 * t + 1
    assert sent > 0.8 * 11520 * t and lidar.line.dropped == 0


@settings(max_examples=15)
@given(st.sampled_from(list(SAMPLES)), st.lists(st.floats(0.0005, 0.3), min_size=1, max_size=10))
def test_the_bytes_do_not_depend_on_the_polling(asked, pauses):
    lidar, t, k, received = machine(), 2.0, 0, b""
    lidar.feed(asked, t)
    while t + pauses[k % len(pauses)] < 3.0 and k < 400:
        t, k = t + pauses[k % len(pauses)], k + 1
        received += lidar.feed(b"", t)
    received += lidar.feed(b"", 3.0)
    assert received == receive(machine(), asked, 2.0, 1.0)


def test_any_request_but_the_motor_s_and_the_board_s_ends_a_scan():
    for other in (STOP, INFO, HEALTH, conf(Conf.MODE_COUNT), request(0x99, b"")):
        lidar = machine()
        receive(lidar, SCAN, 0.0, 0.5)
        receive(lidar, other, 0.5, 0.1)
        assert receive(lidar, b"", 0.6, 0.5) == b"", other
    for other in (motor_pwm(600), ACC):
        lidar = machine()
        receive(lidar, SCAN, 0.0, 0.5)
        assert len(receive(lidar, other, 0.5, 1.0)) > 9000, other


def test_a_response_follows_the_bytes_already_in_transmission():
    lidar = machine()
    receive(lidar, SCAN, 0.0, 1.0)
    rest = receive(lidar, INFO, 1.0, 0.1)
    at = rest.index(bytes.fromhex("a55a1400000004"))
    assert len(rest) == at + 27 and at < 30


def test_the_descriptor_comes_at_once_and_data_when_the_motor_turns_evenly():
    lidar = machine(spinning=False, spin_up=3.0)
    assert receive(lidar, SCAN, 0.0, 2.0).hex() == "a55a0500004081"  # it does not turn at all
    assert receive(lidar, motor_pwm(660), 2.0, 2.99) == b""
    assert len(receive(lidar, b"", 4.99, 1.0)) > 9000
    receive(lidar, motor_pwm(0), 6.0, 0.1)
    assert receive(lidar, b"", 6.1, 1.0) == b""


def test_a_forced_scan_does_not_wait_and_the_motor_remembers():
    lidar = machine(spinning=False, spin_up=3.0)
    receive(lidar, motor_pwm(660) + STOP, 0.0, 0.1)
    assert len(receive(lidar, FORCE, 0.1, 1.0)) > 9000
    receive(lidar, STOP, 1.1, 5.0)
    assert len(receive(lidar, SCAN, 10.0, 1.0)) > 9000  # long turning


def test_half_the_voltage_turns_half_as_fast():
    lidar = machine()
    receive(lidar, motor_pwm(330), 0.0, 0.1)
    found, _ = nodes(receive(lidar, SCAN, 0.1, 2.0))
    turns = np.diff(np.flatnonzero(found["start"]))
    assert abs(turns.mean() - 200e-3 / 508e-6) < 1


def test_a_protection_stop_prevents_scans_and_a_reset_may_clear_it():
    for heals in (True, False):
        lidar = machine(health=(2, 4), reset_heals=heals)
        assert receive(lidar, SCAN + express(2), 0.0, 0.5) == b""
        lidar.feed(RESET, 1.0)
        assert receive(lidar, INFO, 1.1, 0.9) == BANNER % (1, 29)  # no answer while it boots
        healed = Health.unpack(answers(receive(lidar, HEALTH, 2.0, 0.1))[0][1])
        assert healed == (Health(0, 0) if heals else Health(2, 4))


def test_lost_bytes_and_flipped_bits_are_as_many_as_asked_for():
    clean = receive(machine(), SCAN, 0.0, 4.0)
    flipped = receive(machine(faults=Faults(flip=0.01)), SCAN, 0.0, 4.0)
    changed = [(a ^ b).bit_count() for a, b in zip(clean, flipped, strict=True) if a != b]
    assert 0.006 < len(changed) / len(clean) < 0.014 and set(changed) == {1}
    fewer = receive(machine(faults=Faults(lose=0.01)), SCAN, 0.0, 4.0)
    assert 0.006 < 1 - len(fewer) / len(clean) < 0.014


def test_faults_silent_command_stalled_motor_unplugged():
    lidar = machine(faults=Faults(silent={Command.GET_HEALTH}))
    assert [kind for kind, _ in answers(receive(lidar, HEALTH + INFO, 0.0, 0.2))] == [
        AnswerType.INFO
    ]
    receive(lidar, SCAN, 1.0, 0.5)
    lidar.faults.stalled = True
    receive(lidar, b"", 1.5, 0.1)
    assert receive(lidar, b"", 1.6, 1.0) == b""
    lidar.faults.stalled = False
    assert len(receive(lidar, b"", 2.6, 1.0)) > 9000
    lidar.faults.unplugged = True
    with pytest.raises(OSError):
        lidar.feed(b"", 4.0)


def test_a_client_that_reads_late_loses_data_and_continues():
    lidar = machine()
    receive(lidar, SCAN, 0.0, 0.1)
    burst = lidar.feed(b"", 60.0)
    assert len(burst) < 11520 * 1.1
    assert len(receive(lidar, b"", 60.0, 1.0)) > 9000
