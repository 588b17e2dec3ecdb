"""Folded code: a click opens it, and a lecture folds it in its own way."""

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_output

from tests.course.browser.lecture import Lecture
from tests.course.browser.live import fresh

pytestmark = pytest.mark.slow

LESSON, HELPED = "folded.ipynb", "helped.ipynb"
LINES = "\n".join(f"line_{k} = {k}" for k in range(9))
SHOWN = new_output("stream", text="what it shows\n")
FOLDED = {"jupyter": {"source_hidden": True}, "tags": ["folded"]}


def slide(kind):
    """Metadata of a cell that begins a slide."""
    return {"slideshow": {"slide_type": kind}}


def write(file, *cells):
    """Write a lesson."""
    nbformat.write(fresh(*cells), file)


@pytest.fixture
def lesson(visit, lab_folder):
    """A page with a slide of folded code."""
    write(
        lab_folder / LESSON,
        new_markdown_cell("# A slide", metadata=slide("slide")),
        new_code_cell(LINES, metadata=FOLDED, outputs=[SHOWN], execution_count=1),
    )
    visit.page.set_viewport_size({"width": 1280, "height": 720})
    visit.open(LESSON)
    visit.page.get_by_text("what it shows").wait_for()
    return visit.page


def test_a_click_opens_it(lesson):
    assert lesson.locator(".jp-CodeCell .cm-content").count() == 0
    folded = lesson.locator(".jp-CodeCell .jp-InputPlaceholder")
    assert "line_0 = 0" in folded.text_content()
    folded.click()
    lesson.locator(".jp-CodeCell .cm-content", has_text="line_8 = 8").wait_for()


def test_a_lecture_opens_it_at_wish_and_leaves_it_as_it_was(visit, lesson, lab_folder):
    before = (lab_folder / LESSON).read_bytes()
    lecture = Lecture(visit)
    lecture.start()
    assert lesson.locator(".jp-InputPlaceholder").count() == 0
    assert lecture.seen["telling"] == []  # the output stands for it
    lecture.press("c")
    lesson.locator(".jp-CodeCell .cm-content:visible", has_text="line_4 = 4").wait_for()
    lecture.press("Escape")
    lesson.locator(".jp-CodeCell .jp-InputPlaceholder").wait_for()
    assert lesson.get_by_role("button", name="Restore it").count() == 0
    visit.save()
    saved = nbformat.reads((lab_folder / LESSON).read_text(), 4)
    assert saved.cells == nbformat.reads(before.decode(), 4).cells


ASKED = """from classroom.checks.question_widgets import ask_choice
ask_choice("00-x", "Which one?", {"this": "it is.", "that": "it is not."}, "this");
"""


@pytest.fixture
def question(visit, lab_folder):
    """A page with a question, whose answers in code and in words are folded."""
    shown, answers = new_output("stream", text="the answer\n"), {"answers": "00-x"}
    code = {"jupyter": {"outputs_hidden": True, "source_hidden": True}, "slamlab": answers}
    words = {"jupyter": {"source_hidden": True}, "slamlab": answers}
    cells = [
        new_markdown_cell("# A question"),
        new_code_cell(ASKED),
        new_code_cell("print('the', 'answer')", metadata=code, outputs=[shown], execution_count=1),
        new_markdown_cell("What it means.", metadata=words),
        new_code_cell("print('the', 'end')"),
    ]
    write(lab_folder / "question.ipynb", *cells)
    visit.open("question.ipynb")
    return visit.page


def answers_of(question):
    """The answers that are seen, in code and in words."""
    texts = "the answer", "What it means."
    return [question.get_by_text(text, exact=True).locator("visible=true") for text in texts]


def test_answers_stay_folded_when_all_is_run_and_open_once_they_are_asked_for(visit, question):
    answer, words = answers_of(question)
    visit.run_all()
    question.get_by_text("the end", exact=True).wait_for()
    assert (answer.count(), words.count()) == (0, 0)
    question.get_by_role("button", name="show me").click()
    answer.wait_for()
    words.wait_for()
    visit.run_all()
    question.get_by_text("The answer is A: it is.").wait_for(state="hidden")  # asked again
    visit.settle()
    assert (answer.count(), words.count()) == (1, 1)


def test_a_reader_without_an_answer_learns_what_opens_it(visit, question):
    """Cell by cell, as students run them: what answers the question stays folded."""
    answer, words = answers_of(question)
    question.locator(".jp-Cell").first.click()
    for _ in range(5):
        question.keyboard.press("Shift+Enter")
    question.get_by_text("the end", exact=True).wait_for()
    assert (answer.count(), words.count()) == (0, 0)
    reported = question.locator("[data-slamlab-answers] .jp-Placeholder-contentContainer:visible")
    message = "node => getComputedStyle(node, '::after').content"
    assert "answer the question above" in reported.last.evaluate(message)
    words_cell = question.locator(".jp-MarkdownCell[data-slamlab-answers]")
    words_cell.locator(".jp-InputPlaceholder").click()
    words.wait_for()
    question.keyboard.press("Shift+Enter")  # who has opened it keeps it open
    visit.settle()
    assert words.count() == 1


def test_a_lesson_that_was_only_shown_is_as_it_was(visit, question):
    lecture = Lecture(visit)
    lecture.start()
    answer, words = answers_of(question)
    lecture.go_on_to("what it means", words.count)
    assert answer.count() == 1
    lecture.end()
    assert question.get_by_role("button", name="Restore it").count() == 0
    assert (answer.count(), words.count()) == (0, 0)


def test_a_slide_has_no_more_of_the_code_than_the_notebook(visit, lab_folder):
    write(
        lab_folder / HELPED,
        new_markdown_cell("# A slide", metadata=slide("slide")),
        new_code_cell("def helper(): ...", metadata=FOLDED | slide("subslide"), execution_count=1),
        new_code_cell(
            LINES, metadata=FOLDED | slide("fragment"), outputs=[SHOWN], execution_count=2
        ),
        new_code_cell(f"{LINES}\nlist(", outputs=[SHOWN], execution_count=3),
    )
    visit.open(HELPED)
    lecture = Lecture(visit)
    lecture.start()
    first, second = lecture.walk()  # the helper, which shows nothing, begins the next one's slide
    assert (first["shown"], second["shown"]) == ("0/0", "2,3/0")
    assert lecture.number == "2 / 2"
    assert second["telling"] == ["line_8 = 8"]  # what is folded by the lecture alone has a line
