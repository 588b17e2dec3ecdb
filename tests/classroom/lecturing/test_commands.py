"""slamlab rehearse and slamlab handout, in a real browser."""

import json
import re
import shutil
import zlib

import nbformat
import pytest
from nbformat.v4 import new_output

from classroom.lecturing import headless
from classroom.lecturing.lesson_page import SCREEN, open_lesson
from slamlab.cli import main

BLUE, RED = b"0 .4471 .698", b".8353 .3686 0"  # colours of ink, as a PDF has them


@pytest.fixture(scope="module", autouse=True)
def browser():
    try:
        with headless.chromium():
            pass
    except headless.Unavailable as reason:
        pytest.skip(str(reason))


def pages(file):
    """How many pages a PDF has, and the sizes of its paper [pt]."""
    data = file.read_bytes()
    sizes = re.findall(rb"/MediaBox\s*\[0 0 ([\d.]+) ([\d.]+)\]", data)
    for packed in re.findall(rb"stream\r?\n(.*?)endstream", data, re.S):
        try:
            data += zlib.decompress(packed)
        except zlib.error:
            continue
    return len(re.findall(rb"/Type\s*/Page\b", data)), {tuple(map(float, s)) for s in sizes}, data


@pytest.mark.slow
def test_a_failing_cell_and_a_slide_too_full_are_found_and_a_lesson_is_not_changed(write, capsys):
    notebook = write()
    before = notebook.read_bytes()
    assert main(["rehearse", str(notebook)]) == 0
    output = capsys.readouterr().out
    assert "Second" in output and "No problems were found" in output
    assert re.search(r"The rehearsal took \d+ s\.", output)
    assert notebook.read_bytes() == before
    text = "\n\n".join(f"line {k}" for k in range(70))
    assert main(["rehearse", str(write("1 / 0", text))]) == 1
    output = capsys.readouterr().out
    assert "cell the-cell: ZeroDivisionError" in output and "does not fit the screen" in output
    assert main(["rehearse", str(write(text="## Second\n\nMove the slider."))]) == 1
    assert "mentions a control that is on another slide" in " ".join(
        capsys.readouterr().out.split()
    )


@pytest.mark.slow
def test_cells_that_never_end_time_out(write, capsys):
    assert main(["rehearse", str(write("time.sleep(1e6)")), "--patience", "0.3"]) == 2
    assert "stopped at Second: slide 2, cell the-cell" in capsys.readouterr().err


@pytest.mark.slow
def test_a_handout_has_a_page_for_each_slide_and_its_text(write, tmp_path):
    notebook, out = write(), tmp_path / "out.pdf"
    assert main(["handout", str(notebook), "--out", str(out)]) == 0
    count, sizes, data = pages(out)
    assert count == 2 and sizes == {(960.0, 540.0)}
    assert b"/Font" in data  # text, no picture of it
    assert b"/Title (Tiny)" in data and b"/Outlines" in data  # and its bookmarks


@pytest.mark.slow
def test_a_handout_does_not_print_hints_to_run_a_cell(write):
    notebook = write()
    lesson = nbformat.read(notebook, 4)
    texts = "Run this cell to answer.", "Run this cell for its controls.", "Run this cell twice."
    lesson.cells[-1].outputs = [new_output("display_data", {"text/plain": text}) for text in texts]
    nbformat.write(lesson, notebook)
    with open_lesson(notebook, SCREEN) as page:
        page.start()
        page.call("handout.js", "leaves", {"notes": False})
        message = page.page.locator(".slamlab-book").inner_text()
    assert [text in message for text in texts] == [False, False, True]


@pytest.mark.slow
def test_notes_are_printed_on_white_portrait_pages(write, tmp_path):
    out = tmp_path / "out.pdf"
    assert main(["handout", str(write()), "--notes", "--out", str(out)]) == 0
    count, ((width, height),), data = pages(out)
    assert count == 1 and height > width, "both slides and their notes fill one page"
    assert not re.search(rb"(\.7\d* ){3}rg", data), "JupyterLab's grey is below the notes"


TORN = '{"version": 1, "strokes": [{'  # a file of ink


def stroke(cell, colour="blue"):
    """A stroke on the first text of a cell."""
    anchor = {"cell": cell, "kind": "text", "nth": 0}
    points = [[0, 0, 0.5], [60, 10, 0.5], [90, 0, 0.5]]
    look = {"id": f"{cell}-{colour}", "tool": "pen", "colour": colour, "width": 3}
    return look | {"anchor": anchor, "points": points}


@pytest.mark.slow
def test_a_handout_has_the_ink_and_reports_missing_strokes(write, tmp_path, capsys):
    notebook, out = write(), tmp_path / "out.pdf"
    cells = [cell.id for cell in nbformat.read(notebook, as_version=4).cells]
    ink = notebook.with_suffix(".ink.json")
    strokes = [stroke(cells[0]), stroke(cells[3], "red"), stroke("no cell")]
    ink.write_text(TORN)
    spare = notebook.with_suffix(".ink.spare.json")
    spare.write_text(json.dumps({"version": 1, "strokes": strokes}))
    assert main(["handout", str(notebook), "--out", str(out)]) == 1
    assert set(re.findall(rb"([\d.]+ [\d.]+ [\d.]+) RG", pages(out)[2])) >= {BLUE, RED}
    assert ": 1 strokes are not printed" in capsys.readouterr().err

    spare.unlink()
    assert main(["handout", str(notebook), "--out", str(out)]) == 1
    assert "could not be read" in capsys.readouterr().err
    assert pages(out)[0] == 2
    assert ink.read_text() == TORN


def test_an_invalid_notebook_is_reported(tmp_path, capsys):
    (tmp_path / "no.ipynb").write_text("nothing")
    assert main(["rehearse", str(tmp_path / "no.ipynb")]) == 2
    assert "is not a notebook" in capsys.readouterr().err


def test_no_browser_is_reported_with_what_to_install(write, monkeypatch, capsys):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    monkeypatch.setattr(headless, "CHANNELS", ())
    assert main(["handout", str(write())]) == 2
    assert "install" in capsys.readouterr().err
