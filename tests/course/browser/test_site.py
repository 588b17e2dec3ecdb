"""Site and pack, opened as files: on a desktop, on a phone, in dark mode, with search."""

import html
import json
import re
import shutil
import zipfile

import pytest

from course import pack
from course.site import building, site_checks, student_pack_pages
from tests.course.browser.firefox import Missing, firefox
from tests.course.browser.watching import SERIOUS, faults, fits, watch
from tests.course.setup.test_pack import all_programs, solutions
from tests.timeouts import until

pytestmark = pytest.mark.slow
SCREENS = {"desktop": (1280, "light"), "dark": (1280, "dark"), "phone": (390, "light")}
PAGES = ["index", "literature", "guides/architecture", "notebooks/in_print"]
PAGES += ["notebooks/04_models_and_jacobians", "exercises/ex04_models_and_jacobians"]
MOVING = "notebooks/01_why_slam.html"
TO_ITS_START = """
(film) => {
  const [scrubber, speed] = ["input", "select"].map((name) => film.querySelector(name));
  [scrubber.value, speed.value] = [0, 5];
  scrubber.dispatchEvent(new Event("input"));
  return film.querySelector("input").value;
}
"""
LOADED = "document.fonts.ready.then(() => document.readyState == 'complete')"


@pytest.fixture(scope="module")
def work(tmp_path_factory):
    """A folder to build in, with KaTeX and nothing else."""
    if not shutil.which("npm"):
        pytest.skip("no npm here: KaTeX, which sets the formulas, cannot be fetched")
    folder = tmp_path_factory.mktemp("site") / "work"
    try:
        building.katex_modules(folder)
    except building.SiteError as reason:
        pytest.skip(str(reason))
    return folder


@pytest.fixture(scope="module")
def site(work):
    """The whole site, built from nothing; of the lessons only 01 moves, for each takes a while."""
    assert building.build(work.parent / "out", work, {"01"}) == []
    return work.parent / "out"


@pytest.fixture(scope="module")
def unpacked(work):
    """The folder that the students' pack unpacks into."""
    pages = student_pack_pages.pages(work, {"01"})
    target = work.parent / "pack.zip"
    pack.pack(target, pack.contents(pages=pages))
    zipfile.ZipFile(target).extractall(work.parent)
    return work.parent / pack.TOP


@pytest.fixture(params=SCREENS)
def visitor(request, browser):
    """Open a page on a screen; record its errors and its requests to other hosts."""
    wide, scheme = SCREENS[request.param]
    context = browser.new_context(viewport={"width": wide, "height": 800}, color_scheme=scheme)
    page, wrong = context.new_page(), []
    watch(page, ("file:",), wrong, wrong)

    def open_page(file, asked=""):
        page.goto(file.as_uri() + asked)
        page.wait_for_function(LOADED)
        return page

    yield open_page
    context.close()
    assert wrong == []


@pytest.fixture
def look(visitor, site):
    """Open a page of the site."""
    return lambda name, asked="": visitor(site / name, asked)


def test_nothing_is_wrong_with_any_page(site):
    assert site_checks.problems(site) == []


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_sound_fits_and_can_be_read_by_all(look, name):
    check(look(f"{name}.html"))


@pytest.mark.soak
def test_every_page_is_sound_fits_and_can_be_read_by_all(look, site):
    for path in sorted(site.rglob("*.html")):
        check(look(path.relative_to(site)))


def check(page):
    assert fits(page), page.url
    # the spans of a formula are hidden from screen readers, which get its MathML
    assert faults(page, {"exclude": [[".katex-html"]]}, SERIOUS) == []


@pytest.mark.parametrize("words", ["Jacobian", "ψ", "P_ri", "H_r", "Δθ", "theta"])
def test_the_search_finds(look, words):
    page = look("search.html", f"?q={words}")
    page.locator("#search-results li").first.wait_for()


def test_a_page_that_was_read_is_ticked(look):
    page = look("notebooks/01_why_slam.html")
    page.get_by_role("button", name="Mark as read").click()
    page.reload()
    assert page.get_by_role("button", name="Read ✓").get_attribute("aria-pressed") == "true"
    assert page.locator(".sidebar-tree a.slamlab-was-read").count() == 1


def test_the_film_of_the_first_page_plays_to_its_end(look):
    page = look("index.html")
    watch_film(page, page.locator(".slamlab-film").first)


def test_the_film_of_the_first_page_plays_to_its_end_in_firefox(site):
    try:
        with firefox() as tab:
            tab.open((site / "index.html").as_uri())
            watch_there(tab, "document.querySelector('.slamlab-film')")
            assert tab.wrong == []
    except Missing as reason:
        pytest.skip(str(reason))


def watch_there(tab, film):
    tab.evaluate(f"{film}.scrollIntoView()")
    until(lambda: tab.evaluate(f"!!{film}.querySelector('.slamlab-live')?.dataset.frame"))
    assert tab.evaluate(f"({TO_ITS_START})({film})") == "0"
    tab.evaluate(f"{film}.querySelector('button').click()")
    until(lambda: tab.evaluate(f"{film}.querySelector('button').textContent") == "▶ play")
    last = tab.evaluate(f"{film}.querySelector('input').max")
    assert int(last) > 100
    until(lambda: tab.evaluate(f"{film}.querySelector('.slamlab-live').dataset.frame") == last)


def watch_film(page, place):
    place.scroll_into_view_if_needed()
    film = place.locator(".slamlab-live[data-frame]")
    film.wait_for()
    button = film.get_by_role("button").first
    if "pause" in button.text_content():  # it plays as soon as it is seen
        button.click()
    scrubber = film.get_by_role("slider", name="frame")
    last = int(scrubber.get_attribute("max"))
    assert last > 100
    scrubber.focus()
    page.keyboard.press("Home")
    film.get_by_label("speed").select_option("5")
    button.click()
    film.get_by_role("button", name="▶ play").wait_for()
    # its last frame is painted after it has ended
    film.and_(page.locator(f'[data-frame="{last}"]')).wait_for()


def test_each_value_of_a_slider_has_its_picture_and_its_words(look):
    page = look(MOVING)
    place = page.locator(".slamlab-sliders").first
    picture, slider = place.locator("img"), place.get_by_role("slider").first
    controls = json.loads(place.locator("script").text_content())["controls"]
    still = picture.get_attribute("src")
    for at, alt in enumerate(controls[0]["alts"]):
        slider.evaluate(
            "(one, at) => { one.value = at; one.dispatchEvent(new Event('input')); }", at
        )
        page.wait_for_function(
            "([picture, before]) => picture.complete && picture.naturalWidth > 0",
            arg=[picture.element_handle(), still],
        )
        assert picture.get_attribute("src").endswith(controls[0]["pictures"][at])
        assert picture.get_attribute("alt") == alt
        assert slider.get_attribute("aria-valuetext") == controls[0]["words"][at]
    other = place.get_by_role("slider").nth(1)
    other.focus()
    page.keyboard.press("End")
    assert picture.get_attribute("src").endswith(controls[1]["pictures"][-1])
    assert slider.input_value() == str(controls[0]["first"])  # one moves at a time


def test_the_pack_opens_with_its_lessons_and_their_films(visitor, unpacked):
    page = visitor(unpacked / "index.html")
    page.wait_for_url("**/pages/index.html")
    watch_film(page, page.locator(".slamlab-film").first)
    lessons = sorted(path.stem for path in (pack.ROOT / "notebooks").glob("*.ipynb"))
    page.locator(f'.sidebar-tree a[href$="{lessons[4]}.html"]').dispatch_event("click")
    page.wait_for_url(f"**/{lessons[4]}.html")
    page.wait_for_function(LOADED)
    assert page.locator(".katex").count() > 20
    assert page.evaluate("document.fonts.check('12px KaTeX_Math')")


def test_the_packs_pages_are_its_lessons_and_reveal_no_solution(unpacked):
    pages = unpacked / student_pack_pages.FOLDER
    assert site_checks.problems(pages) == []
    lessons = {path.stem for path in (unpacked / "notebooks").glob("*.ipynb")}
    assert {path.stem for path in pages.glob("*/*.html")} == lessons
    for path in pages.rglob("*.html"):
        message = html.unescape(re.sub(r"<[^>]+>", "", path.read_text(encoding="utf-8")))
        assert [source for source in solutions() | all_programs() if source in message] == [], path


def test_a_pack_that_is_too_large_is_reported(monkeypatch, tmp_path, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(pack, "LARGEST", 1e6)
    assert pack.main(["--no-pages"]) == 1
    assert "larger than 1 MB" in capsys.readouterr().err
