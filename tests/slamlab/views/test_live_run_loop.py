"""Run loop of a live view, with back-pressure, on a screen without a browser."""

import asyncio

import numpy as np
import pytest

from slamlab.live import run_loop
from slamlab.live.estimator_run import EstimatorRun
from slamlab.live.run_loop import RunLoop
from tests.slamlab.views.live_fakes import Car, FakeScreen, Sum, Walk, until


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Steps as fast as they are drawn."""
    monkeypatch.setattr(run_loop, "FRAME_RATE", 1000)
    monkeypatch.setattr(run_loop, "MIN_PAUSE", 0.0)
    monkeypatch.setattr(run_loop, "IDLE_POLL", 0.001)
    yield
    run_loop.stop()


def made(source=Walk, estimator=lambda source: Sum(), at_once=True, play=False, **more):
    pair = EstimatorRun(source, estimator, **more)
    pair.reset(3)
    return RunLoop(pair, FakeScreen(at_once), seed=3, speed=1000, play=play)


def tracks(loop):
    return [len(scene.layers[-2].xy) for scene in loop.screen.scenes]


async def test_it_shows_every_step_and_pauses_at_the_end_from_which_it_begins_again():
    loop = made()
    for _ in range(2):
        loop.run()
        await until(lambda: not loop.running)
    assert tracks(loop) == [2, 3, 4, 5] * 2
    assert loop.screen.most == 1


async def test_the_loop_waits_until_a_picture_is_drawn():
    loop = made(at_once=False)
    loop.run()
    await until(lambda: tracks(loop))
    await asyncio.sleep(0.05)
    assert tracks(loop) == [2]
    loop.screen.draw()
    await until(lambda: len(tracks(loop)) == 2)
    await asyncio.sleep(0.05)
    assert tracks(loop) == [2, 3]
    loop.pause()
    assert loop.screen.most == 1


async def test_only_the_newest_of_waiting_pictures_is_shown():
    loop = made(at_once=False)
    for _ in range(4):
        loop.step()
    assert tracks(loop) == [2]
    loop.screen.draw()
    assert tracks(loop) == [2, 5]
    assert loop.screen.most == 1


async def test_pause_ends_the_steps_and_run_goes_on_from_there():
    loop = made(lambda rng: Walk(rng, 200))
    loop.run()
    await until(lambda: len(tracks(loop)) > 3)
    loop.pause()
    count = loop.pair.count
    await asyncio.sleep(0.05)
    assert loop.pair.count == count < 200
    loop.run()
    await until(lambda: not loop.running)
    assert tracks(loop) == list(range(2, 201))


async def test_a_reset_makes_the_same_again_and_another_seed_makes_another():
    loop = made()
    ends = []
    for seed in (3, 3, 4):
        loop.reset(seed)
        loop.run()
        await until(lambda: not loop.running)
        ends.append(loop.pair.estimator.pose[0])
    assert ends[0] == ends[1] != ends[2]
    assert len({scene.run for scene in loop.screen.scenes}) == 3


async def test_each_button_press_runs_one_step():
    loop = made(Car)
    for name in ("forward", "left", "stop", "back", "nonsense", None):
        loop.drive(name)
    assert loop.pair.source.commands == [(0.4, 0.0), (0.0, 0.6), (-0.4, 0.0)]
    assert loop.pair.count == 4


async def test_buttons_steer_a_running_loop_and_stop_stops_it():
    loop = made(Car)
    loop.run()
    await asyncio.sleep(0.02)
    assert loop.running and loop.pair.count == 1  # no command yet
    loop.drive("forward")
    await until(lambda: loop.pair.count > 4)
    loop.drive("stop")
    await asyncio.sleep(0.02)
    count = loop.pair.count
    await asyncio.sleep(0.02)
    assert loop.running and loop.pair.count == count
    loop.pause()
    assert set(loop.pair.source.commands) == {(0.4, 0.0)}


async def test_a_recording_is_not_driven_and_reports_it():
    loop = made()
    loop.drive("forward")
    status = loop.screen.scenes[-1].status
    assert status == "⚠ a walk is a recording: there is no robot to drive"


async def test_an_error_in_a_step_stops_the_loop_and_is_reported():
    loop = made(estimator=lambda source: Sum(fails_at=3))
    loop.run()
    await until(lambda: not loop.running)
    await asyncio.sleep(0.01)
    assert [scene.status for scene in loop.screen.scenes][-1] == ("⚠ ZeroDivisionError: too small")
    # the picture stays
    assert len(loop.screen.scenes[-1].layers[-2].xy) == 3


async def test_an_error_in_drawing_is_reported_and_the_last_picture_stays():
    broken = []
    loop = made(extra=lambda pair: broken)
    loop.step()
    broken.append(np.zeros(3))
    loop.run()
    await until(lambda: not loop.running)
    await asyncio.sleep(0.01)
    assert "cannot draw ndarray" in loop.screen.scenes[-1].status
    assert tracks(loop)[-1] == 2


async def test_a_step_after_a_corrected_mistake_forgets_it():
    broken = [None]
    loop = made(extra=lambda pair: broken)
    loop.step()
    await until(lambda: loop.screen.free)
    broken.clear()
    loop.step()
    first, second = (scene.status for scene in loop.screen.scenes)
    assert first.startswith("⚠") and second.startswith("step 3 of 5")


async def test_only_one_loop_runs_at_a_time():
    first, second = (made(lambda rng: Walk(rng, 10_000)) for _ in range(2))
    first.run()
    await until(lambda: len(tracks(first)) > 1)
    second.run()
    assert second.running and not first.running
    second.pause()


async def test_play_starts_when_the_browser_is_ready_and_after_a_reload():
    loop = made(lambda rng: Walk(rng, 10_000), at_once=False, play=True)
    assert not loop.running and not loop.screen.scenes
    loop.screen.open()
    assert loop.running
    loop.screen.draw()
    await until(lambda: len(tracks(loop)) > 1)
    # what was on its way to the page before is lost with it
    shown = len(tracks(loop))
    loop.screen.open()
    loop.screen.draw()
    await until(lambda: len(tracks(loop)) > shown + 1)
    loop.screen.on_closed()
    assert not loop.running


async def test_nothing_plays_automatically_with_reduced_motion():
    loop = made(lambda rng: Walk(rng, 10_000), at_once=False, play=True)
    loop.screen.calm = True
    loop.screen.open()
    assert loop.screen.scenes and not loop.running
    loop.run()
    assert loop.running
    loop.pause()


async def test_truth_other_estimators_and_the_note_are_shown_up_to_the_current_step():
    loop = made(beside={"naive": lambda source: Sum()}, note=lambda pair: "all is well")
    loop.step()
    (scene,) = loop.screen.scenes
    shown = {layer.name: layer for layer in scene.layers}
    assert list(shown) == ["truth", "naive", "map", "corrected"]
    assert np.allclose(shown["truth"].rows, shown["naive"].rows)
    assert scene.status == "step 2 of 5 · t = 1.0 s · all is well"


async def test_curves_are_measured_after_each_step_and_restart_with_a_reset():
    curves = {"way [m]": {"corrected": lambda pair: pair.estimator.pose[0]}}
    loop = made(curves=curves)
    loop.step()
    await until(lambda: loop.screen.free)
    loop.reset()
    await until(lambda: loop.screen.free)
    two, one = (scene.curves["way [m]"]["corrected"] for scene in loop.screen.scenes)
    truth = loop.pair.source.truth
    assert np.allclose(two, np.column_stack([truth.times, truth.poses[:, 0]])[:2])
    assert one == two[:1]


async def test_an_estimator_handed_in_ready_made_cannot_be_reset():
    loop = made(estimator=Sum())
    loop.reset(1)
    assert "a function that creates one" in loop.screen.scenes[-1].status
