"""Run loop of a live view, with back-pressure, on a screen without a browser."""

import asyncio

import numpy as np
import pytest

from slamlab.views.live import run_loop
from slamlab.views.live.run_loop import RunLoop
from slamlab.views.live.stepper import Stepper
from tests.views.live_fakes import Car, FakeScreen, Sum, Walk, until


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Steps as fast as they are drawn."""
    monkeypatch.setattr(run_loop, "FRAME_RATE", 1000)
    monkeypatch.setattr(run_loop, "MIN_PAUSE", 0.0)
    monkeypatch.setattr(run_loop, "IDLE_POLL", 0.001)
    yield
    run_loop.stop()


def made(source=Walk, estimator=lambda source: Sum(), at_once=True, play=False, **more):
    pair = Stepper(source, estimator, **more)
    pair.reset(3)
    return RunLoop(pair, FakeScreen(at_once), seed=3, speed=1000, play=play)


def tracks(loop):
    return [len(scene.layers[-2].xy) for scene in loop.screen.scenes]


def test_it_shows_every_step_to_the_end_and_then_pauses():
    loop = made()

    async def watch():
        loop.run()
        await until(lambda: not loop.running)

    asyncio.run(watch())
    assert tracks(loop) == [2, 3, 4, 5]
    assert loop.screen.most == 1


def test_run_again_at_the_end_starts_from_the_beginning():
    loop = made()

    async def watch():
        for _ in range(2):
            loop.run()
            await until(lambda: not loop.running)

    asyncio.run(watch())
    assert tracks(loop) == [2, 3, 4, 5] * 2


def test_nothing_goes_on_while_a_picture_is_not_drawn():
    loop = made(at_once=False)

    async def watch():
        loop.run()
        await until(lambda: tracks(loop))
        await asyncio.sleep(0.05)
        assert tracks(loop) == [2]
        loop.screen.draw()
        await until(lambda: len(tracks(loop)) == 2)
        await asyncio.sleep(0.05)
        assert tracks(loop) == [2, 3]
        loop.pause()

    asyncio.run(watch())
    assert loop.screen.most == 1


def test_of_pictures_that_must_wait_only_the_newest_is_shown():
    loop = made(at_once=False)

    async def watch():
        for _ in range(4):
            loop.step()
        assert tracks(loop) == [2]
        loop.screen.draw()

    asyncio.run(watch())
    assert tracks(loop) == [2, 5]
    assert loop.screen.most == 1


def test_pause_ends_the_steps_and_run_goes_on_from_there():
    loop = made(lambda rng: Walk(rng, 200))

    async def watch():
        loop.run()
        await until(lambda: len(tracks(loop)) > 3)
        loop.pause()
        count = loop.pair.count
        await asyncio.sleep(0.05)
        assert loop.pair.count == count < 200
        loop.run()
        await until(lambda: not loop.running)

    asyncio.run(watch())
    assert tracks(loop) == list(range(2, 201))


def test_a_reset_makes_the_same_again_and_another_seed_makes_another():
    loop = made()
    ends = []

    async def watch():
        for seed in (3, 3, 4):
            loop.reset(seed)
            loop.run()
            await until(lambda: not loop.running)
            ends.append(loop.pair.estimator.pose[0])

    asyncio.run(watch())
    assert ends[0] == ends[1] != ends[2]
    assert len({scene.run for scene in loop.screen.scenes}) == 3


def test_a_reset_may_change_to_another_pair():
    loop, other = made(), Stepper(Car, lambda source: Sum())

    async def watch():
        loop.reset(pair=other)

    asyncio.run(watch())
    assert loop.pair is other and other.count == 1


def test_a_robot_is_driven_a_step_a_press():
    loop = made(Car)

    async def watch():
        for name in ("forward", "left", "stop", "back", "nonsense", None):
            loop.drive(name)

    asyncio.run(watch())
    assert loop.pair.source.commands == [(0.4, 0.0), (0.0, 0.6), (-0.4, 0.0)]
    assert loop.pair.count == 4


def test_while_it_runs_a_press_steers_and_stop_stands_still():
    loop = made(Car)

    async def watch():
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

    asyncio.run(watch())
    assert set(loop.pair.source.commands) == {(0.4, 0.0)}


def test_a_recording_is_not_driven_and_says_so():
    loop = made()

    async def watch():
        loop.drive("forward")

    asyncio.run(watch())
    status = loop.screen.scenes[-1].status
    assert status == "⚠ a walk is a recording: it cannot be driven"


def test_a_mistake_in_a_step_stops_the_loop_and_is_told_in_one_line():
    loop = made(estimator=lambda source: Sum(fails_at=3))

    async def watch():
        loop.run()
        await until(lambda: not loop.running)
        await asyncio.sleep(0.01)

    asyncio.run(watch())
    assert [scene.status for scene in loop.screen.scenes][-1] == ("⚠ ZeroDivisionError: too small")
    # the picture stays
    assert len(loop.screen.scenes[-1].layers[-2].xy) == 3


def test_a_mistake_in_what_is_drawn_is_told_and_the_last_picture_stays():
    broken = []
    loop = made(extra=lambda pair: broken)

    async def watch():
        loop.step()
        broken.append(np.zeros(3))
        loop.run()
        await until(lambda: not loop.running)
        await asyncio.sleep(0.01)

    asyncio.run(watch())
    assert "cannot draw ndarray" in loop.screen.scenes[-1].status
    assert tracks(loop)[-1] == 2


def test_a_step_after_a_mistake_is_mended_forgets_it():
    broken = [None]
    loop = made(extra=lambda pair: broken)

    async def watch():
        loop.step()
        broken.clear()
        loop.step()

    asyncio.run(watch())
    first, second = (scene.status for scene in loop.screen.scenes)
    assert first.startswith("⚠") and second.startswith("step 3 of 5")


def test_only_one_loop_runs_at_a_time():
    first, second = (made(lambda rng: Walk(rng, 10_000)) for _ in range(2))

    async def watch():
        first.run()
        await until(lambda: len(tracks(first)) > 1)
        second.run()
        assert second.running and not first.running
        second.pause()

    asyncio.run(watch())


def test_it_begins_when_the_browser_is_ready_and_again_after_that_is_opened_anew():
    loop = made(lambda rng: Walk(rng, 10_000), at_once=False, play=True)

    async def watch():
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

    asyncio.run(watch())


def test_nothing_begins_by_itself_for_who_asked_for_reduced_motion():
    loop = made(lambda rng: Walk(rng, 10_000), at_once=False, play=True)
    loop.screen.calm = True

    async def watch():
        loop.screen.open()
        assert loop.screen.scenes and not loop.running
        loop.run()
        assert loop.running
        loop.pause()

    asyncio.run(watch())


def test_truth_those_beside_and_the_note_are_shown_as_far_as_it_went():
    loop = made(beside={"naive": lambda source: Sum()}, note=lambda pair: "all is well")

    async def watch():
        loop.step()

    asyncio.run(watch())
    (scene,) = loop.screen.scenes
    shown = {layer.name: layer for layer in scene.layers}
    assert list(shown) == ["truth", "naive", "map", "corrected"]
    assert np.allclose(shown["truth"].rows, shown["naive"].rows)
    assert scene.status == "step 2 of 5 · t = 1.0 s · all is well"


def test_curves_are_measured_after_each_step_and_begin_anew_with_a_reset():
    curves = {"way [m]": {"corrected": lambda pair: pair.estimator.pose[0]}}
    loop = made(curves=curves)

    async def watch():
        loop.step()
        loop.reset()

    asyncio.run(watch())
    two, one = (scene.curves["way [m]"]["corrected"] for scene in loop.screen.scenes)
    truth = loop.pair.source.truth
    assert np.allclose(two, np.column_stack([truth.times, truth.poses[:, 0]])[:2])
    assert one == two[:1]


def test_an_estimator_handed_in_ready_made_cannot_be_reset():
    loop = made(estimator=Sum())

    async def watch():
        loop.reset(1)

    asyncio.run(watch())
    assert "hand in what makes one" in loop.screen.scenes[-1].status
