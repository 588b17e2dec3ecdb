"""The course in Firefox: JupyterLab, an exercise, a lecture."""

import json

import nbformat
import pytest

from course.source import ROOT
from tests.course.browser.firefox import Missing, firefox
from tests.timeouts import until

pytestmark = pytest.mark.slow
TASK, EXERCISE, LESSON = "04-h-robot", "ex04_models_and_jacobians.ipynb", "00_start_here.ipynb"
# a window of headless Firefox never has the focus, by which JupyterLab knows the current notebook
READY = """(() => {
    const shell = window.jupyterapp?.shell;
    const [panel] = shell?.widgets("main") ?? [];
    panel?.node.dispatchEvent(new FocusEvent("focus"));
    return shell?.currentWidget?.sessionContext?.session?.kernel?.status == "idle";
})()"""
# run the first cell, the cell of the solution, and the check of it; what the check shows
SOLVE = """(async () => {
    const solution = SOLUTION, check = CHECK;
    const { content, sessionContext } = window.jupyterapp.shell.currentWidget;
    const cells = content.widgets.filter((cell) => cell.model.type == "code");
    const place = cells.findIndex((cell) => cell.model.sharedModel.source == check);
    cells[place - 1].model.sharedModel.setSource(solution);
    for (const cell of [cells[0], cells[place - 1], cells[place]]) {
        content.activeCellIndex = content.widgets.indexOf(cell);
        await window.jupyterapp.commands.execute("notebook:run-cell");
    }
    return JSON.stringify(cells[place].model.sharedModel.outputs);
})()"""
NUMBER = "document.querySelector('.slamlab-number')?.textContent ?? ''"
START = "document.querySelector('.slamlab-lecture-start').click()"
NEXT = "window.dispatchEvent(new KeyboardEvent('keydown', { key: 'PageDown', bubbles: true }))"


@pytest.fixture
def tab():
    try:
        with firefox() as opened:
            yield opened
    except Missing as reason:
        pytest.skip(str(reason))


def test_an_exercise_is_solved_and_checked_and_a_slide_turns(tab, lab):
    cells = nbformat.read(ROOT / "solutions" / EXERCISE, 4).cells
    (check,) = (k for k, cell in enumerate(cells) if cell.source == f'check("{TASK}")')
    tab.open(lab.format(f"exercises/{EXERCISE}"))
    until(lambda: tab.evaluate(READY))
    solve = SOLVE.replace("SOLUTION", json.dumps(cells[check - 1].source))
    shown = tab.evaluate(solve.replace("CHECK", json.dumps(cells[check].source)))
    assert "3.5 of 3.5" in shown, shown
    tab.open(lab.format(f"notebooks/{LESSON}"))
    until(lambda: tab.evaluate(READY))
    tab.evaluate(START)
    until(lambda: tab.evaluate(NUMBER))
    first = tab.evaluate(NUMBER)
    tab.evaluate(NEXT)
    until(lambda: tab.evaluate(NUMBER) != first)
    assert tab.wrong == []
