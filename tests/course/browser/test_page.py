"""A notebook in JupyterLab for students: clean, with next steps, on narrow screens."""

import json

import pytest

from tests.course.browser.jupyter import Visit

pytestmark = pytest.mark.slow

LESSON, EXERCISE = "notebooks/00_start_here.ipynb", "exercises/ex01_why_slam.ipynb"
FIGURES = ".jp-OutputArea-output img"


def progress(lab_folder):
    return json.loads((lab_folder.parent / "progress.json").read_text("utf-8"))


def cell_of(visit, text):
    """The code cell whose source holds a text."""
    return visit.page.locator(".jp-CodeCell").filter(
        has=visit.page.locator(".jp-InputArea").get_by_text(text, exact=False)
    )


def run_cell(visit, cell):
    cell.locator(".cm-content").click()
    visit.page.keyboard.press("Control+Enter")
    visit.page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]")


@pytest.mark.parametrize("notebook", [LESSON, EXERCISE])
def test_a_notebook_that_was_only_opened_is_not_unsaved(visit, notebook):
    visit.open(notebook)
    visit.page.wait_for_selector(".slamlab-progress li")
    visit.page.wait_for_timeout(1500)  # JupyterLab writes what it knows of the kernel
    assert not visit.is_dirty
    assert visit.errors == visit.foreign_requests == []


def test_a_change_by_the_reader_is_unsaved(visit):
    visit.open(LESSON)
    visit.page.locator(".jp-CodeCell .cm-content").first.click()
    visit.page.keyboard.type("# mine")
    visit.page.wait_for_selector(".lm-TabBar-tab.jp-mod-dirty")


def test_an_answer_opens_what_was_folded_and_is_kept(visit, lab_folder):
    visit.open(LESSON)
    asked, answer = cell_of(visit, '"00-missing"'), cell_of(visit, "One revolution of the lidar")
    assert answer.locator("img").count() == 0, "the picture that answers is not folded"
    run_cell(visit, cell_of(visit, "from classroom.checks import ask"))
    run_cell(visit, asked)
    asked.get_by_role("button", name="B", exact=True).click()
    asked.get_by_text("✓ B: a beam ends where it first meets a surface.").wait_for()
    answer.locator("img").wait_for()
    kept = progress(lab_folder)["questions"]["00-missing"]
    assert (kept["answer"], kept["right"], kept["times"]) == ("B", True, 1)
    visit.page.locator(".slamlab-progress li", has_text="✓ missing").wait_for()


def test_words_that_explain_an_answer_open_with_it_and_show_no_line_before(visit):
    visit.open("notebooks/04_models_and_jacobians.ipynb")
    visit.page.locator(".jp-CodeCell .jp-InputPlaceholder").first.click()  # imports are folded
    run_cell(visit, cell_of(visit, "from classroom.checks import ask"))
    asked = cell_of(visit, '"04-streak"')
    run_cell(visit, asked)
    folded = asked.locator("xpath=following-sibling::*").locator(".jp-Placeholder")
    reported = visit.page.locator(
        ".jp-RenderedMarkdown", has_text="The streak lies across the path"
    )
    folded.nth(0).scroll_into_view_if_needed()
    assert [each.inner_text().strip() for each in folded.all()[:2]] == ["", ""]  # picture, words
    assert reported.count() == 0
    asked.get_by_role("button", name="C", exact=True).click()
    reported.wait_for()


def test_a_check_is_kept_and_shown_at_the_head_of_the_notebook(visit, lab_folder):
    visit.open(EXERCISE)
    head = visit.page.locator(".slamlab-progress li").first
    assert head.text_content().startswith("○ next-pose")
    run_cell(visit, visit.page.locator(".jp-CodeCell").first)
    run_cell(visit, cell_of(visit, "def next_pose"))
    run_cell(visit, cell_of(visit, 'check("01-next-pose")'))
    visit.page.locator(".slamlab-progress li", has_text="◐ next-pose").wait_for()
    assert progress(lab_folder)["tasks"]["01-next-pose"]["points"] == 0


@pytest.mark.parametrize("width", [390, 820])
def test_on_a_narrow_screen_the_side_bar_is_closed_and_figures_fit(browser, lab, width):
    context = browser.new_context(viewport={"width": width, "height": 800}, has_touch=True)
    visit = Visit(context.new_page(), lab)
    visit.open(LESSON)
    visit.page.wait_for_selector(FIGURES)
    assert visit.page.locator("#jp-left-stack").is_hidden()
    ends = "all => all.map((one) => one.getBoundingClientRect().right)"
    assert max(visit.page.locator(FIGURES).evaluate_all(ends)) <= width
    context.close()
