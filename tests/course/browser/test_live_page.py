"""``slamlab live`` with typed commands from a real browser; viewers, and unauthorised clients."""

import asyncio
from concurrent.futures import Future, ThreadPoolExecutor
from functools import partial

import numpy as np
import pytest

from slamlab import estimators
from slamlab.devices.clock import SimulatedClock
from slamlab.live import films
from slamlab.live.console.console_server import serve
from slamlab.live.console.control_panel import ControlPanel
from slamlab.live.console.recorded_run import RecordedRun
from slamlab.simulation import worlds
from slamlab.sources.emulated_devices import EmulatedDevices
from slamlab.sources.simulated_robot import ROUTES
from tests.course.browser.live_page import LivePage, started
from tests.course.browser.watching import faults, fits
from tests.slamlab.devices.test_emulator_ports import needs_pty, running
from tests.timeouts import PATIENCE, until

pytestmark = pytest.mark.slow

PAINTED = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"

# places in Tuček's polygon [m], there and back
POLYGON = [(0.3, -0.2), (0.2, -0.6), (-0.2, -0.3), (0.2, 0.2), (0.0, 0.0)]


@pytest.fixture
def look(browser):
    """Open a page of a live run by its address; nothing goes wrong on it."""
    opened = []

    def open_page(address):
        opened.append(LivePage(browser, address))
        return opened[-1]

    yield open_page
    for each in opened:
        each.close()
        assert each.errors == [] and each.foreign_requests == []


@pytest.fixture
def live(look):
    """Start ``slamlab live`` with some words, and open its page."""
    running = []

    def begin(*words):
        process, address = started(*words)
        running.append(process)
        return look(address)

    yield begin
    for process in running:
        process.kill()
        process.communicate()


@pytest.fixture
def served(look):
    """Serve a source that is made here, and open its page."""
    running = []

    def begin(make_source, estimator):
        stepper = RecordedRun(make_source, partial(estimators.make, estimator))
        address = Future()

        async def serve_it():
            stepper.reset(0)
            await serve(ControlPanel(stepper, "served"), started=address.set_result)

        running.append((ThreadPoolExecutor(1), stepper))
        task = running[-1][0].submit(asyncio.run, serve_it())
        task.add_done_callback(
            lambda done: address.done() or address.set_exception(done.exception())
        )
        return look(address.result(PATIENCE)), stepper

    yield begin
    for thread, stepper in running:
        thread.shutdown()
        stepper.close()


@pytest.mark.parametrize("seed", range(5))
def test_typed_through_situation_2_the_walls_know_where_it_is(live, seed, tmp_path):
    film, picture = tmp_path / "a.film", tmp_path / "map.png"
    words = ("--speed", "100", "--seed", str(seed), "--film", str(film), "--map", str(picture))
    run = live("sim:situation-2", "--estimator", "walls", *words)
    for place in ROUTES["situation-2"]:
        run.go_to(*place)
    assert np.hypot(*run.pose()[:2]) < 0.1  # home again
    run.page.get_by_role("button", name="save map").click()
    run.page.get_by_text("is in map.png").wait_for()
    run.exit()
    until(film.exists)
    *_, (_, last) = films.load(film)
    tracks = {each.name: each.rows for each in last if each.kind == "poses"}
    rms, naive = (
        np.sqrt(np.mean(np.square(np.hypot(*(tracks[name] - tracks["truth"])[:, :2].T))))
        for name in ("corrected", "naive")
    )
    print(f"seed {seed}: rms {rms:.4f} m of {len(tracks['truth'])} poses, naive {naive:.3f} m")
    assert len(tracks["truth"]) > 60 and rms <= 0.01 < naive
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_typed_through_the_polygon_icp_knows_where_the_emulated_robot_is(served):
    """Emulators, the real drivers between, in simulated time: as many turns on any machine."""

    def emulated(rng):
        return EmulatedDevices(worlds.polygon(), rng, clock=SimulatedClock())

    run, stepper = served(emulated, "icp")
    for place in POLYGON:
        run.go_to(*place)
    run.type("exit")
    run.page.get_by_text("The program has ended.").wait_for()
    true, pose = stepper.source.truth.poses[: stepper.count][-1], stepper.estimator.pose
    off = np.hypot(*(pose - true)[:2])
    naive = np.hypot(*(stepper.estimator.naive_pose - true)[:2])
    print(f"off {off:.4f} m, {np.degrees(pose[2] - true[2]):.2f}°, naive {naive:.3f} m")
    assert np.hypot(*true[:2]) < 0.1 and off <= 0.03 < naive


@needs_pty
@pytest.mark.soak
def test_typed_through_the_polygon_in_real_time_on_two_ports(live):
    """In real time; where the machine is kept from it, the emulated world waits."""
    with running() as it:
        run = live("devices:" + ",".join(it.ports.values()), "--estimator", "icp")
        for place in POLYGON:
            run.go_to(*place)
        until(lambda: not it.body._speeds.any())
        stood = run.steps()
        until(lambda: run.steps() > stood + 10)  # the lidar has turned where it stands
        off = np.hypot(*(run.pose() - it.body.pose)[:2])
        print(f"off {off:.4f} m")
        assert off <= 0.03
        run.exit()
        until(lambda: it["lidar"].pwm == 0)


def test_a_viewer_sees_the_run_and_does_not_control_it(live):
    run = live("sim:room", "--estimator", "icp", "--speed", "5")
    other = run.look()
    run.page.get_by_role("button", name="▲ forward").click()
    other.get_by_text("another page is driving").wait_for()
    other.get_by_role("button", name="◀ left").click()
    other.get_by_text("another client is driving").wait_for()
    other.get_by_role("button", name="■ stop").click()
    other.get_by_text("the robot stops").wait_for()
    run.page.locator("#driver", has_text="drive").wait_for(state="detached")
    # and by keys, once nobody drives
    other.locator("canvas").click()
    other.keyboard.press("ArrowLeft")
    run.page.get_by_text("another page is driving").wait_for()
    other.close()
    run.page.locator("#driver", has_text="driving").wait_for(state="detached")


def test_odometry_alone_is_switched_off_and_on_in_one_page_alone(live):
    run = live("sim:situation-2", "--estimator", "walls", "--tour", "--speed", "100")
    other = run.look()
    for page in (run.page, other):
        page.locator(".slamlab-status", has_text="step 1").wait_for()
    names = "feedOfPage.layers.visible.map((layer) => layer.name)"
    run.page.get_by_label("odometry alone").uncheck()
    assert "naive" not in run.page.evaluate(names)
    assert "naive" in other.evaluate(names)
    run.page.get_by_label("odometry alone").check()
    assert "naive" in run.page.evaluate(names)


def test_without_the_token_a_page_shows_nothing(live):
    run = live("sim:room", "--estimator", "icp")
    unauthorised = run.look(run.address.split("#")[0] + "#guessed")
    unauthorised.get_by_text("The token is wrong").wait_for()
    assert unauthorised.locator("canvas").count() == 0
    again = run.look(run.address.split("#")[0])
    again.get_by_text("Access denied").wait_for()
    assert again.locator("canvas").count() == 0
    again.route("**/login", lambda route: route.abort())  # as if the program had ended
    again.goto("about:blank")
    again.goto(run.address.split("#")[0] + "#guessed")
    again.get_by_text("The program has ended").wait_for()
    run.errors.clear()  # the browser's own words on what was refused


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_page_can_be_used_by_all(live, scheme):
    run = live("sim:room", "--estimator", "icp")
    run.page.emulate_media(color_scheme=scheme)
    run.page.set_viewport_size({"width": 1280, "height": 720})
    line = run.page.locator("#typed").bounding_box()
    assert line["y"] + line["height"] <= 720  # in sight below the picture
    run.page.set_viewport_size({"width": 390, "height": 800})
    run.page.evaluate(PAINTED)  # in the colours of that scheme
    assert fits(run.page)
    assert faults(run.page) == []
