"""The button that moves a slider: it draws every step once, ends, stops, and never plays twice."""

import asyncio

import ipywidgets
import pytest

from slamlab import views
from slamlab.views import play_button, sliders
from tests.patience import PATIENCE
from tests.views.displays import Displays

ALT = "a line"


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Pictures as fast as they are drawn, and none shown."""
    monkeypatch.setattr(play_button, "FRAME_PERIOD", 0.0)
    monkeypatch.setattr(play_button, "MIN_PAUSE", 0.0)
    Displays(monkeypatch, sliders)
    yield
    play_button.stop()


@pytest.fixture
def buttons(monkeypatch):
    """Every button that is made."""
    made, button = [], ipywidgets.Button

    def make(**rest):
        made.append(button(**rest))
        return made[-1]

    monkeypatch.setattr(play_button.ipywidgets, "Button", make)
    return made


class Film:
    """A function to explore that remembers which steps it drew."""

    def __init__(self, fails_at=None):
        self.steps, self.fails_at = [], fails_at

    def __call__(self, step, **_):
        self.steps.append(step)
        if step == self.fails_at:
            raise ZeroDivisionError
        return views.chart("t [s]", "x [m]")[0]


async def until(done, patience=PATIENCE):
    async with asyncio.timeout(patience):
        while not done():
            await asyncio.sleep(0.001)


def idle():
    return play_button._playing is None


def test_without_a_press_only_the_first_view_is_drawn(buttons):
    film = Film()
    views.explore(film, ALT, play="step", step=(0, 5, 2))
    assert film.steps == [2]
    assert [button.description for button in buttons] == ["▶ play"]


def test_a_press_draws_every_step_once_to_the_end_and_then_rests(buttons):
    film = Film()
    views.explore(film, ALT, play="step", step=(0, 5, 2))

    async def watch():
        buttons[0].click()
        assert buttons[0].description == "❚❚ pause"
        await until(idle)

    asyncio.run(watch())
    assert film.steps == [2, 3, 4, 5]
    assert buttons[0].description == "▶ play"


def test_played_from_its_end_it_starts_again(buttons):
    film = Film()
    views.explore(film, ALT, play="step", step=(0, 3, 3))

    async def watch():
        buttons[0].click()
        await until(idle)

    asyncio.run(watch())
    assert film.steps == [3, 0, 1, 2, 3]


def test_a_second_press_pauses_and_a_third_goes_on_from_there(buttons):
    film = Film()
    views.explore(film, ALT, play="step", step=(0, 9, 0))

    async def watch():
        buttons[0].click()
        await until(lambda: len(film.steps) > 3)
        buttons[0].click()
        assert idle()
        drawn = len(film.steps)
        await asyncio.sleep(0.05)
        assert len(film.steps) == drawn < 10
        buttons[0].click()
        await until(idle)

    asyncio.run(watch())
    assert film.steps == list(range(10))


@pytest.mark.slow
def test_a_cell_that_is_run_again_stops_what_it_played_before(buttons):
    old, new = Film(), Film()

    async def watch():
        views.explore(old, ALT, play="step", step=(0, 9, 0))
        buttons[0].click()
        await until(lambda: len(old.steps) > 1)
        views.explore(new, ALT, play="step", step=(0, 9, 0))
        buttons[1].click()
        await until(idle)

    asyncio.run(watch())
    assert len(old.steps) < 10
    assert new.steps == list(range(10))
    assert buttons[0].description == "▶ play"


def test_only_one_plays_at_a_time(buttons):
    first, second = Film(), Film()

    async def watch():
        for film in (first, second):
            views.explore(film, ALT, play="step", step=(0, 9, 0))
        for button in buttons:
            button.click()
            await until(lambda: len(first.steps) > 1)
        await until(idle)

    asyncio.run(watch())
    assert len(first.steps) < 10
    assert len(second.steps) == 10


def test_it_is_never_faster_than_it_is_drawn_and_leaves_the_kernel_time(buttons, monkeypatch):
    monkeypatch.setattr(play_button, "MIN_PAUSE", 0.01)
    film, waits, sleep = Film(), [], asyncio.sleep

    async def note(seconds):
        waits.append((len(film.steps), seconds))
        await sleep(0)

    views.explore(film, ALT, play="step", step=(0, 4, 0))

    async def watch():
        monkeypatch.setattr(play_button.asyncio, "sleep", note)
        buttons[0].click()
        task = play_button._playing._task
        await task

    asyncio.run(watch())
    # one picture before every wait, and a wait after every picture
    assert [drawn for drawn, _ in waits] == [2, 3, 4, 5]
    assert all(seconds >= 0.01 for _, seconds in waits)


def test_a_mistake_while_it_plays_stops_it(buttons):
    film = Film(fails_at=3)
    views.explore(film, ALT, play="step", step=(0, 9, 0))

    async def watch():
        buttons[0].click()
        await until(idle)
        await asyncio.sleep(0.01)

    asyncio.run(watch())
    assert film.steps == [0, 1, 2, 3]


def test_a_reader_who_moves_the_slider_meanwhile_is_followed(buttons):
    film, slider = Film(), ipywidgets.IntSlider(0, 0, 9)
    views.explore(film, ALT, play="step", step=slider)

    async def watch():
        buttons[0].click()
        await until(lambda: len(film.steps) > 1)
        slider.value = 7
        await until(idle)

    asyncio.run(watch())
    assert film.steps[-3:] == [7, 8, 9]
    assert 6 not in film.steps


@pytest.mark.parametrize("name", ["time", "which"])
def test_what_is_no_slider_cannot_be_played(name):
    with pytest.raises(ValueError, match="play"):
        views.explore(Film(), ALT, play=name, step=(0, 9, 0), which=["a", "b"])
