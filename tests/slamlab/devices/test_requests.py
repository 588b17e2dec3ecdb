"""Requests, descriptors and answers, byte by byte as Slamtec's devices have them."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.devices.errors import ProtocolError
from slamlab.devices.rplidar.requests import Command, Conf, conf, express, motor_pwm, request
from slamlab.devices.rplidar.responses import (
    AnswerType,
    Descriptor,
    Health,
    Info,
    ResponseFinder,
    SampleRate,
    conf_value,
)

REQUESTS = [
    (request(Command.STOP), "a5 25"),
    (request(Command.RESET), "a5 40"),
    (request(Command.SCAN), "a5 20"),
    (request(Command.FORCE_SCAN), "a5 21"),
    (request(Command.GET_INFO), "a5 50"),
    (request(Command.GET_HEALTH), "a5 52"),
    (request(Command.GET_SAMPLERATE), "a5 59"),
    (express(0), "a5 82 05 00 00 00 00 00 22"),
    (express(2), "a5 82 05 02 00 00 00 00 20"),
    (motor_pwm(660), "a5 f0 02 94 02 c1"),
    (motor_pwm(1023), "a5 f0 02 ff 03 ab"),
    (request(Command.GET_ACC_BOARD_FLAG, bytes(4)), "a5 ff 04 00 00 00 00 5e"),
    (conf(Conf.MODE_COUNT), "a5 84 04 70 00 00 00 55"),
    (conf(Conf.TYPICAL_MODE), "a5 84 04 7c 00 00 00 59"),
    (conf(Conf.DESIRED_ROTATION), "a5 84 04 01 00 00 00 24"),
    (conf(Conf.US_PER_SAMPLE, 1), "a5 84 06 71 00 00 00 01 00 57"),
    (conf(Conf.NAME, 0), "a5 84 06 7f 00 00 00 00 00 58"),
    (conf(Conf.ANSWER_TYPE, 2), "a5 84 06 75 00 00 00 02 00 50"),
]
DESCRIPTORS = [
    (Descriptor(20, False, AnswerType.INFO), "a5 5a 14 00 00 00 04"),
    (Descriptor(3, False, AnswerType.HEALTH), "a5 5a 03 00 00 00 06"),
    (Descriptor(4, False, AnswerType.SAMPLERATE), "a5 5a 04 00 00 00 15"),
    (Descriptor(5, True, AnswerType.SCAN), "a5 5a 05 00 00 40 81"),
    (Descriptor(84, True, AnswerType.EXPRESS), "a5 5a 54 00 00 40 82"),
    (Descriptor(132, True, AnswerType.ULTRA), "a5 5a 84 00 00 40 84"),
    (Descriptor(84, True, AnswerType.DENSE), "a5 5a 54 00 00 40 85"),
    (Descriptor(13, False, AnswerType.CONF), "a5 5a 0d 00 00 00 20"),
    (Descriptor(4, False, AnswerType.ACC_BOARD_FLAG), "a5 5a 04 00 00 00 ff"),
]
INFO = bytes.fromhex("18 1d 01 07 92 d8 ed 93 c0 ea 98 c9 a5 e6 98 f2 07 06 46 69")
INFO_ANSWER = Descriptor(20, False, AnswerType.INFO).pack() + INFO


@pytest.mark.parametrize(("made", "expected"), REQUESTS)
def test_a_request_is_the_bytes_that_the_protocol_specifies(made, expected):
    assert made == bytes.fromhex(expected)


@pytest.mark.parametrize(("descriptor", "expected"), DESCRIPTORS)
def test_a_descriptor_is_encoded_and_decoded_as_the_protocol_specifies(descriptor, expected):
    assert descriptor.pack() == bytes.fromhex(expected)
    assert Descriptor.unpack(bytes.fromhex(expected)) == descriptor


@pytest.mark.parametrize("wrong", [-1, 1024])
def test_a_motor_speed_out_of_range_is_refused(wrong):
    with pytest.raises(ValueError, match="0 to 1023"):
        motor_pwm(wrong)


def test_a_payload_goes_with_commands_that_take_one_only():
    with pytest.raises(ValueError, match="must not have a payload"):
        request(Command.STOP, b"x")


def test_the_identity_of_a_real_device_is_decoded():
    info = Info.unpack(INFO)
    assert (info.model, info.firmware, info.hardware) == (0x18, (1, 29), 7)
    assert info.serial == "92D8ED93C0EA98C9A5E698F207064669"


def test_a_health_code_is_little_endian():
    assert Health.unpack(bytes([1, 0x01, 0x02])) == Health(1, 0x0201)
    assert "0x0201" in str(Health(1, 0x0201))


def test_sample_rates_are_microseconds():
    rate = SampleRate.unpack(struct.pack("<HH", 508, 254))
    assert (rate.standard, rate.express) == pytest.approx((508e-6, 254e-6))


def test_configuration_values_come_in_their_units():
    def answer(what, value):
        return struct.pack("<I", what) + value

    assert conf_value(Conf.MODE_COUNT, answer(0x70, b"\x03\0")) == 3
    assert conf_value(Conf.US_PER_SAMPLE, answer(0x71, struct.pack("<I", 65024))) == 254
    assert conf_value(Conf.MAX_DISTANCE, answer(0x74, struct.pack("<I", 3072))) == 12
    assert conf_value(Conf.ANSWER_TYPE, answer(0x75, b"\x84")) == 0x84
    assert conf_value(Conf.NAME, answer(0x7F, b"Standard\0")) == "Standard"


@pytest.mark.parametrize("payload", [b"", b"\x70\0\0\0", b"\x71\0\0\0\x03\0"])
def test_a_configuration_answer_that_is_invalid_is_a_protocol_error(payload):
    with pytest.raises(ProtocolError, match="What to do:"):
        conf_value(Conf.MODE_COUNT, payload)


@given(st.binary(max_size=400), st.lists(st.integers(1, 40), max_size=60))
def test_a_response_is_found_after_stale_bytes_in_any_chunks(stale, cuts):
    stale = stale.replace(
        b"\xa5\x5a", b"\xa5\x5b"
    )  # a false descriptor cannot be distinguished from one
    if stale.endswith(b"\xa5"):
        stale = stale[:-1]
    data, found = stale + INFO_ANSWER + b"rest", None
    finder = ResponseFinder(AnswerType.INFO, length=20)
    while found is None and data:
        n = cuts.pop() if cuts else len(data)
        found, data = finder.feed(data[:n]), data[n:]
    assert found == (Descriptor(20, False, AnswerType.INFO), INFO)
    assert finder.rest + data == b"rest"


def test_answers_to_other_questions_are_passed_over_and_reported():
    health = Descriptor(3, False, AnswerType.HEALTH).pack() + b"\0\0\0"
    finder = ResponseFinder(AnswerType.INFO, length=20)
    assert finder.feed(health + INFO_ANSWER)[1] == INFO
    assert [d.type for d in finder.others] == [AnswerType.HEALTH]


@given(st.binary(max_size=3000))
def test_a_finder_never_fails_and_keeps_little(data):
    finder = ResponseFinder(AnswerType.INFO, length=20)
    finder.feed(data)
    assert len(finder._buffer) < 27
