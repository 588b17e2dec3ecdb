"""What a student and a lecturer see in JupyterLab."""

from course.source import ROOT
from tests.notebooks import load

HIDDEN = ("notes", "skip")


def test_the_course_opens_without_an_error_and_asks_no_other_machine_for_anything(visit):
    visit.open("00_start_here.ipynb")
    visit.page.wait_for_selector(".jp-RenderedHTML img")
    assert visit.errors == []
    assert visit.abroad == []


def test_a_key_reveals_one_line_of_a_derivation_after_another(visit):
    notebook = next((ROOT / "notebooks").glob("04_*.ipynb"))
    types = [c.metadata.get("slideshow", {}).get("slide_type") for c in load(notebook).cells]
    lines = derivation(types)[:6]
    assert len(lines) >= 3, "no derivation is marked to be revealed line by line"

    visit.open(notebook.name)
    visit.page.click('[data-jp-item-name="deck"]')
    wait_for_active(visit, 0)
    for stop in (n for n in range(1, lines[-1] + 1) if types[n] not in HIDDEN):
        visit.page.keyboard.press("Space")
        wait_for_active(visit, stop)
        if stop in lines:
            shown = visible(visit)
            assert [n for n in lines if n in shown] == lines[: lines.index(stop) + 1]
            assert not [n for n in shown if types[n] in HIDDEN], "notes stand on the slide"
    visit.page.keyboard.press("Escape")
    visit.page.wait_for_selector(".jp-deck-mod-visible", state="detached")
    assert visit.errors == []
    assert visit.abroad == []


def derivation(types):
    """Positions of the fragments of the first slide that has most of them."""
    slides = []
    for position, kind in enumerate(types):
        if kind in ("slide", "subslide"):
            slides.append([])
        elif kind == "fragment" and slides:
            slides[-1].append(position)
    return max(slides, key=len, default=[])


def wait_for_active(visit, position):
    """Wait until the deck stands at a cell, given by its position in the notebook."""
    visit.page.wait_for_selector(
        f'.jp-deck-mod-visible.jp-mod-active[data-windowed-list-index="{position}"]'
    )


def visible(visit):
    """Positions of the cells that can be seen."""
    return visit.page.locator(".jp-Cell").evaluate_all(
        """cells => cells
            .filter(cell => getComputedStyle(cell).visibility == "visible")
            .filter(cell => getComputedStyle(cell).opacity > 0)
            .map(cell => Number(cell.dataset.windowedListIndex))"""
    )
