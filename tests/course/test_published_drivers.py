"""Published drivers: each has the printed mistake that lesson 14 shows."""

import numpy as np

from course.studies import published_drivers as printed
from slamlab.devices.emir import commands
from slamlab.devices.emir.status import Status
from slamlab.geometry import matrix


def test_the_printed_command_is_right_just_where_its_bytes_add_to_255_at_most():
    for speed in range(-100, 101, 10):
        for turn in range(-100, 101, 10):
            same = printed.move(speed, turn).encode() == commands.move(speed, turn)
            assert same == (speed % 256 + turn % 256 <= 255), (speed, turn)


def test_standing_still_is_not_noticed_and_a_drive_may_be_taken_for_it():
    assert not printed.transformation_is_zero(matrix([0, 0, 0]))
    assert printed.transformation_is_zero(matrix([-3, 0, 0]))


def test_sensor_0_is_left_out_and_every_byte_gets_a_sign():
    text = Status(proximity=(35, 80, 80, 80, 62, 41), azimuth=150).pack().decode()
    assert printed.values_for_sensors(text, [0, 1, 13]) == [80, 150 - 256]


def test_the_loop_ends_at_an_empty_scan():
    assert printed.slam_routine([[1], [1], [], [1]]) == 2
    assert printed.slam_routine([[1]] * 4) == 4


def test_a_generator_for_each_turn_loses_the_reading_that_begins_the_next():
    readings = iter([(k % 3 == 0, k) for k in range(10)])
    assert printed.requested_turns(readings, 2) == [[0, 1, 2], [4, 5]]


def test_two_programs_share_a_map_and_main_calls_neither_of_its_methods():
    try:
        printed.App().points.append(1)
        assert printed.App().points == [1]
    finally:
        printed.App.points.clear()
    assert printed.main().called == []
    program = printed.main()
    program.start()
    program.robot_control()
    assert program.called == ["start", "robot_control"]


def test_a_flush_at_once_leaves_nothing_sent_and_a_late_one_all():
    assert printed.bytes_sent(0) == 0
    assert printed.bytes_sent(1) == 10


def test_without_a_third_coordinate_nothing_is_shifted():
    points = np.array([[1.0, 2.0]])
    moved = matrix([5, 0, 0]) @ printed.to_homogeneous(points)
    np.testing.assert_array_equal(moved[:2].T, points)


def test_the_pseudo_codes_loop_never_begins():
    assert printed.slam_routine_iterations() == 0


def test_the_document_differs_from_the_program_by_its_signs_and_its_first_k():
    # all 1000 mm; offsets 58/8 degrees, the top bit set: by the document minus 26/8
    cabin = bytes.fromhex("a30fa30faa")
    capsule, following = (bytes([0xA0, 0x50, *start, *cabin * 16]) for start in ((0, 0), (0, 8)))
    found = printed.as_documented(capsule, following)
    np.testing.assert_allclose(found[:, 0], np.arange(1, 33) + 26 / 8)
    np.testing.assert_array_equal(found[:, 1], 1000)
