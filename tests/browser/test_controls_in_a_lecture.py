"""Every control of every lesson works on its slide, at several zooms, by pointer and by keys."""

import pytest

from tests.browser.controls import Controls
from tests.browser.lecture import Lecture
from tests.browser.test_lecture import LESSONS

pytestmark = pytest.mark.walk

ZOOMS = {"usual": "0", "large": "0++", "largest": "0++++", "small": "0--", "smallest": "0----"}
MANY = ("09_slam_with_walls.ipynb", "14_the_emir_system.ipynb")  # robots are driven in them
CASES = [(lesson, [list(ZOOMS)[k % len(ZOOMS)]]) for k, lesson in enumerate(LESSONS)]
CASES = [(lesson, [*ZOOMS] if lesson in MANY else zooms) for lesson, zooms in CASES]
CASES = [(lesson, zoom) for lesson, zooms in CASES for zoom in zooms]


@pytest.mark.parametrize(("lesson", "zoom"), CASES)
def test_every_control_works_where_it_is_seen_and_by_keys(visit, lesson, zoom):
    visit.page.set_viewport_size({"width": 1280, "height": 720})
    visit.open(lesson)
    visit.run_all_and_wait()
    lecture = Lecture(visit)
    lecture.start()
    for key in ZOOMS[zoom]:
        lecture.press(key)
    lecture.press("Home")
    controls = Controls(lecture)
    wrong, count = [], 0
    for _ in lecture.walk():
        while found := list(controls.unworked()):  # one may show others
            for kind, place in found:
                wrong += controls.work(kind, place)
            count += len(found)
    assert count and wrong == []
    assert visit.faults == []
    assert visit.abroad == []
