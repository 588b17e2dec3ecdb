"""A day at a student's computer: a notebook is opened, run and saved; the next, opened again."""

from course.source import ROOT

PICTURES = ".jp-OutputArea-output img"
LIMIT = 800_000  # of a notebook's file [bytes], outputs of a run included


def notebooks(folder):
    """The notebooks of a folder of the course, by their paths."""
    return [path.relative_to(ROOT).as_posix() for path in sorted((ROOT / folder).glob("*.ipynb"))]


def alternatives(visit):
    """The alternative texts of all pictures."""
    return visit.page.locator(PICTURES).evaluate_all("all => all.map((one) => one.alt)")


def unfold_outputs(visit):
    """Open the outputs that wait for an answer, of all cells; a file keeps them folded."""
    # all at once: each that is opened is one fewer to count by
    folded = visit.page.locator(".jp-OutputPlaceholder:visible")
    folded.evaluate_all("all => all.forEach((one) => one.click())")
    assert folded.count() == 0


def move_by_keyboard(page, handle):
    """Move a slider by a step."""
    before = handle.get_attribute("aria-valuetext")
    handle.focus()
    page.keyboard.press("ArrowLeft")
    if handle.get_attribute("aria-valuetext") == before:  # it stood at its left end
        page.keyboard.press("ArrowRight")
    assert handle.get_attribute("aria-valuetext") != before


def is_whole_and_saved(visit, file):
    """Look through a notebook that was run, move its sliders, and save it.

    Parameters
    ----------
    visit : Visit
    file : Path

    Returns
    -------
    list of str, the alternative texts of its pictures
    """
    page = visit.page
    visit.look_through()
    unfold_outputs(visit)
    wrong = page.locator('[data-mime-type="application/vnd.jupyter.error"]')
    assert wrong.all_text_contents() == []
    assert visit.serious_faults() == []
    for handle in page.get_by_role("slider").all():
        assert handle.get_attribute("aria-label")
        move_by_keyboard(page, handle)
    visit.settle()
    visit.save()
    seen = alternatives(visit)
    assert all(seen)
    assert visit.faults == []
    assert visit.abroad == []
    assert file.stat().st_size < LIMIT
    return seen


def shows(visit, notebook, seen):
    """Open a notebook: it shows the pictures that were seen when it was saved."""
    visit.turn_to(notebook)
    visit.look_through()
    visit.wait_until_clean()
    unfold_outputs(visit)
    assert alternatives(visit) == seen
    assert visit.page.get_by_text("Error displaying widget").count() == 0
    assert visit.page.get_by_text("model not found").count() == 0
