"""The button that moves a slider: it draws every step once, ends, stops, and never plays twice."""

import asyncio

import ipywidgets
import pytest

from slamlab import views
from slamlab.views import play_button, sliders
from tests.slamlab.views.live_fakes import until
from tests.slamlab.views.outputs import Displays

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
    """A function that remembers which steps it drew, and is explored at once."""

    def __init__(self, step=(0, 9, 0), fails_at=None):
        self.steps, self.fails_at = [], fails_at
        views.explore(self, ALT, play="step", step=step)

    def __call__(self, step, **_):
        self.steps.append(step)
        if step == self.fails_at:
            raise ZeroDivisionError
        return views.chart("t [s]", "x [m]", size=(2, 2))[0]


def idle():
    return play_button._playing is None


async def test_playing_draws_every_step_once_and_stops_at_the_end(buttons):
    film = Film((0, 5, 2))
    assert film.steps == [2] and [button.description for button in buttons] == ["▶ play"]
    buttons[0].click()
    assert buttons[0].description == "❚❚ pause"
    await until(idle)
    assert film.steps == [2, 3, 4, 5]
    assert buttons[0].description == "▶ play"


async def test_played_from_its_end_it_starts_again(buttons):
    film = Film((0, 3, 3))
    buttons[0].click()
    await until(idle)
    assert film.steps == [3, 0, 1, 2, 3]


async def test_a_second_press_pauses_and_a_third_goes_on_from_there(buttons):
    film = Film()
    buttons[0].click()
    await until(lambda: len(film.steps) > 3)
    buttons[0].click()
    assert idle()
    drawn = len(film.steps)
    await asyncio.sleep(0.05)
    assert len(film.steps) == drawn < 10
    buttons[0].click()
    await until(idle)
    assert film.steps == list(range(10))


async def test_only_one_plays_at_a_time(buttons):
    first, second = Film(), Film()
    for button in buttons:
        button.click()
        await until(lambda: len(first.steps) > 1)
    await until(idle)
    assert len(first.steps) < 10
    assert len(second.steps) == 10


async def test_playing_waits_for_drawing_and_leaves_time_for_the_kernel(buttons, monkeypatch):
    monkeypatch.setattr(play_button, "MIN_PAUSE", 0.01)
    film, waits, sleep = Film((0, 4, 0)), [], asyncio.sleep

    async def note(seconds):
        waits.append((len(film.steps), seconds))
        await sleep(0)

    monkeypatch.setattr(play_button.asyncio, "sleep", note)
    buttons[0].click()
    await play_button._playing._task
    # one picture before every wait, and a wait after every picture
    assert [drawn for drawn, _ in waits] == [2, 3, 4, 5]
    assert all(seconds >= 0.01 for _, seconds in waits)


async def test_an_error_stops_the_player(buttons):
    film = Film(fails_at=3)
    buttons[0].click()
    await until(idle)
    await asyncio.sleep(0.01)
    assert film.steps == [0, 1, 2, 3]


async def test_playing_continues_from_a_moved_slider(buttons):
    slider = ipywidgets.IntSlider(0, 0, 9)
    film = Film(slider)
    buttons[0].click()
    await until(lambda: len(film.steps) > 1)
    slider.value = 7
    await until(idle)
    assert film.steps[-3:] == [7, 8, 9]
    assert 6 not in film.steps


@pytest.mark.parametrize("name", ["time", "which"])
def test_only_a_slider_can_be_played(name):
    with pytest.raises(ValueError, match="play"):
        views.explore(print, ALT, play=name, step=(0, 9, 0), which=["a", "b"])
