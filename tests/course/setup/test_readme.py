"""What README, CONTRIBUTING and the guides promise is there."""

import re

import pytest

from tests.course.setup import ROOT

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
LESSONS = (ROOT / "docs" / "lessons.md").read_text(encoding="utf-8")
MAP = re.findall(r"\]\(\.\./notebooks/(\w+)\.ipynb\) \| (\d+) \|", LESSONS)


def anchors(text):
    """The anchors of a page's headings, as GitHub and the site make them."""
    headings = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", line).strip().lower().replace(" ", "-") for line in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.stem)
def test_links_and_make_targets_lead_somewhere(page):
    text = page.read_text(encoding="utf-8")
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text("utf-8"), re.M))
    assert set(re.findall(r"`make (?:-C \S+ )?([\w-]+)", text)) <= targets
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        if "://" in link:
            continue
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target.read_text(encoding="utf-8")), link


def test_a_reader_finds_the_start_in_two_minutes():
    readme = PAGES[0].read_text(encoding="utf-8")
    assert len(readme.splitlines()) <= 150
    linked = set(re.findall(r"\]\(docs/(\w+)\.md", readme))
    assert linked == {path.stem for path in (ROOT / "docs").glob("*.md")}


def test_the_map_lists_every_lesson_with_the_minutes_that_it_gives():
    sources = {path.stem: path.read_text("utf-8") for path in ROOT.glob("course/lessons/*.py")}
    assert sorted(name for name, _ in MAP) == sorted(sources)
    for name, minutes in MAP:
        assert re.search(r"(\d+) min", sources[name])[1] == minutes, name
