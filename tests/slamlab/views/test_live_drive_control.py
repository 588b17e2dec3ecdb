"""Typed drive commands: moves driven to their goal, clear error messages for all else."""

from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import estimators, sources
from slamlab.geometry import between, compose
from slamlab.layers import Boxes, Points, Poses, Segments
from slamlab.live import run_loop, shift_layers
from slamlab.live.controls import Controls
from slamlab.live.drive_control import GOAL_TOLERANCE, TurnThenDrive, parse_command
from slamlab.live.estimator_run import EstimatorRun
from slamlab.live.run_loop import RunLoop
from slamlab.readings import Reading
from slamlab.sources.base import Source
from tests.slamlab.views.live_fakes import FakeScreen, Sum, Walk, until

TOPS = 0.4, 0.6


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    for name in ("MIN_PAUSE", "IDLE_POLL"):
        monkeypatch.setattr(run_loop, name, 0.0005)
    monkeypatch.setattr(run_loop, "FRAME_RATE", 1000)
    yield
    run_loop.stop()


class Robot(Source):
    """A robot that moves exactly, with a reading each 0.1 s, and stands without a command."""

    name = "a robot"

    def __init__(self, rng=None):
        super().__init__()
        self.pose, self.command, self.closed, self.commands = np.zeros(3), (0.0, 0.0), 0, []

    def __iter__(self):
        time = 0.0
        while not self.closed:
            v, omega = self.command
            step = compose(np.zeros(3), [0.1 * v, 0.0, 0.1 * omega])
            self.pose = compose(self.pose, step)
            yield Reading(time, step)
            time += 0.1

    def drive(self, command):
        self.command = tuple(command)
        self.commands.append(self.command)

    def close(self):
        self.closed += 1


def odometry(source):
    return estimators.DeadReckoning()


def made(source=Robot, estimator=odometry):
    pair = EstimatorRun(source, estimator)
    pair.reset(0, 1.0)
    return RunLoop(pair, FakeScreen(), speed=1000, tops=TOPS)


@given(st.floats(-100, 100), st.floats(-3600, 3600), st.sampled_from(["{},{}", " {} ,  {} "]))
def test_two_numbers_are_metres_and_degrees(distance, angle, form):
    assert parse_command(form.format(distance, angle)) == (distance, np.radians(angle))


@pytest.mark.parametrize("text", ["reset", " Exit ", "EXIT"])
def test_word_commands_are_accepted_in_any_case(text):
    assert parse_command(text) == text.strip().lower()


@given(st.text())
def test_any_other_line_is_refused_with_the_commands_that_can_be_typed(text):
    try:
        parse_command(text)
    except ValueError as refused:
        assert "Type metres, degrees" in str(refused) or "too far" in str(refused)
        assert "\n" not in str(refused) and len(str(refused)) < 300


@pytest.mark.parametrize("text", ["", "fast", "1", "1, 2, 3", "nan, 0", "inf, 0", "0, 1e9", "1;2"])
def test_invalid_moves_are_refused(text):
    with pytest.raises(ValueError):
        parse_command(text)


@settings(max_examples=50)
@given(st.floats(-2, 2), st.floats(-7, 7))
def test_a_typed_move_ends_at_its_goal_even_after_full_turns(distance, angle):
    way, pose, turned = (
        TurnThenDrive(distance, angle, np.array([1.0, 2.0, 3.0]), TOPS),
        [1.0, 2.0, 3.0],
        0.0,
    )
    start = pose
    for _ in range(2000):
        command = way.steer(pose)
        if command is None:
            break
        v, omega = command
        assert abs(v) <= TOPS[0] and abs(omega) <= TOPS[1]
        turned += 0.1 * omega
        pose = compose(pose, [0.1 * v, 0.0, 0.1 * omega])
    assert command is None
    assert abs(turned - angle) <= 2 * GOAL_TOLERANCE[1]
    goal = compose(start, compose([0, 0, angle], [distance, 0, 0]))
    off = between(goal, pose)
    assert np.hypot(*off[:2]) < GOAL_TOLERANCE[0] + 3 * GOAL_TOLERANCE[1] * abs(distance)


async def test_a_typed_path_is_driven_by_a_robot_with_a_clock_of_its_own_and_then_it_stands():
    loop = made()
    controls = Controls(loop, {"": loop.pair})
    controls.typed.value = "0.5, 30"
    assert controls.typed.value == "" and "30°" in controls.answer.value
    robot = loop.pair.source
    await until(lambda: robot.commands[-1] == (0.0, 0.0))
    goal = 0.5 * np.cos(np.pi / 6), 0.5 * np.sin(np.pi / 6)
    assert np.allclose(robot.pose[:2], goal, atol=0.03)
    assert loop.running
    loop.close()


async def test_a_typed_path_is_driven_by_a_simulated_robot_that_moves_on_command():
    loop = made(partial(sources.simulation, "situation-1", tour=False), odometry)
    loop.drive_control.execute("0.4, -20")
    await until(lambda: loop.pair.count > 3 and loop.pair.command is None)
    x, y, theta = loop.pair.estimator.pose
    assert abs(np.hypot(x, y) - 0.4) < 0.05 and abs(np.degrees(theta) + 20) < 3


async def test_a_button_ends_a_typed_move():
    loop = made()
    loop.drive_control.execute("5, 0")
    loop.drive("left")
    count = loop.pair.count
    await until(lambda: loop.pair.count > count + 5)
    assert loop.pair.source.commands[-1] == (0.0, 0.6)
    loop.close()


async def test_exit_releases_the_robot_and_run_opens_it_again():
    loop = made()
    loop.drive_control.execute("5, 0")
    robot = loop.pair.source
    loop.drive_control.execute("exit")
    assert robot.commands[-1] == (0.0, 0.0) and robot.closed and not loop.running
    loop.run()
    assert loop.pair.source is not robot and not loop.pair.source.closed
    await until(lambda: loop.pair.count > 2)
    loop.close()


async def test_reset_restarts_and_continues_a_running_loop():
    loop = made()
    loop.drive_control.execute("5, 0")
    await until(lambda: loop.pair.count > 3)
    loop.drive_control.execute("reset")
    assert loop.running and loop.pair.runs == 2
    assert loop.pair.source.command == (0.0, 0.0)
    loop.close()


@pytest.mark.parametrize(("source", "message"), [(Walk, "no robot"), (Robot, "is not a command")])
async def test_a_refused_command_is_reported_beside_the_input(source, message):
    loop = made(source, lambda source: Sum())
    controls = Controls(loop, {"": loop.pair})
    loop.run()
    controls.typed.value = "1, 2" if source is Walk else "go on"
    assert message in controls.answer.value
    assert loop.running
    controls.drive[-1].click()  # stop
    assert controls.answer.value == ""
    loop.close()


class Shows:
    """An estimator with a layer of each kind that can be moved."""

    status = "well"

    def layers(self):
        return [
            Points("naive", np.zeros((2, 2))),
            Poses("naive", np.ones((1, 3))),
            Segments("naive", np.zeros((1, 4))),
            Points("corrected", np.zeros((2, 2))),
        ]


def test_layers_are_drawn_beside_each_other_and_all_else_stays():
    there = shift_layers(lambda source: Shows(), naive=(-3, 1))(None)
    points, poses, segments, corrected = there.layers()
    assert np.array_equal(points.xy, [[-3, 1], [-3, 1]])
    assert np.array_equal(poses.rows, [[-2, 2, 1]])
    assert np.array_equal(segments.rows, [[-3, 1, -3, 1]])
    assert not corrected.xy.any()
    assert there.status == "well"


def test_layers_of_a_name_may_be_left_out():
    (corrected,) = shift_layers(lambda source: Shows(), naive=None)(None).layers()
    assert corrected.name == "corrected"


def test_a_layer_that_cannot_be_moved_is_refused():
    shows = Shows()
    shows.layers = lambda: [Boxes("naive", np.zeros((1, 4)))]
    with pytest.raises(TypeError, match="Boxes"):
        shift_layers(lambda source: shows, naive=(1, 1))(None).layers()
