"""What tests ask of a page of JupyterLab; the browser and JupyterLab are those of rehearsals."""

import os
from contextlib import ExitStack, contextmanager
from unittest import mock

from axe_playwright_python.sync_playwright import Axe

from course.source import ROOT
from slamlab.lecturing import headless
from slamlab.lecturing.headless import Unavailable, chromium
from tests.patience import PATIENCE

__all__ = ["Unavailable", "Visit", "chromium", "jupyterlab"]
EXTENSION = ROOT / "labextension" / "share" / "jupyter"
IDLE = ".jp-Notebook-ExecutionIndicator[data-status=idle]"  # out of sight on a narrow page
# anywidget gives up after two seconds, on a busy machine: the cell run again shows the widget
BUSY = "[anywidget] Failed to initialize model."
# JupyterLab asks a kernel that is being ended for its breakpoints
ENDED = "Could not restore the debugger state"

# what was never in sight is not laid out, and further cells come a while after those before them
LOOK_THROUGH = """async (patience) => {
    const { widgets } = window.jupyterapp.shell.currentWidget.content;
    const seen = new Set();
    const end = performance.now() + patience;
    while (seen.size < widgets.length && performance.now() < end) {
        const cells = [...document.querySelectorAll(".jp-Cell")];
        const next = cells.find((one) => !seen.has(one)) ?? cells.at(-1);
        next.scrollIntoView();
        for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
        seen.add(next);
        for (const cell of cells) {
            const { top, bottom } = cell.getBoundingClientRect();
            if (top >= 0 && bottom <= innerHeight) seen.add(cell);
        }
    }
    return seen.size == widgets.length;
}"""

HAS_CODE = """() => window.jupyterapp.shell.currentWidget.content.widgets
    .some(({ model }) => model.type == "code")"""

CELLS_LEFT = """(before) => {
    const prompts = [...document.querySelectorAll(".jp-InputPrompt")];
    const left = prompts.filter((prompt) => prompt.textContent == "[*]:").length;
    return left != before && [left];
}"""
BLANK = "about:"  # of a fresh page
SELDOM = 200  # [ms]; asked for at every frame, the page is painted anew at every frame

# JupyterLab has written what it knows of the kernel; what the kernel was asked before is shown
SETTLED = """async () => {
    const { context, sessionContext } = window.jupyterapp.shell.currentWidget;
    await Promise.all([context.ready, sessionContext.ready]);
    const { kernel } = sessionContext.session;
    await Promise.all([kernel.info, kernel.spec]);
    await kernel.requestKernelInfo(); // answered after all that was sent before
    await new Promise(requestAnimationFrame);
}"""

# one notebook in the place of all that were open, whose kernels end
TURN_TO = """async (path) => {
    const { shell, commands } = window.jupyterapp;
    const before = [...shell.widgets("main")];
    const panel = await commands.execute("docmanager:open", { path, factory: "Notebook" });
    shell.activateById(panel.id);
    while (shell.currentWidget !== panel) await new Promise(requestAnimationFrame);
    for (const panel of before) {
        await panel.sessionContext?.shutdown();
        panel.dispose();
    }
}"""


@contextmanager
def jupyterlab(home):
    """A JupyterLab with the extension as it stands here, not as it was installed."""
    # a test is no student, but these play one: their progress is kept
    student = {name: value for name, value in os.environ.items() if name != "PYTEST_VERSION"}
    with ExitStack() as running:
        with mock.patch.dict(os.environ, student, clear=True):
            lab = headless.jupyterlab(home, {"JUPYTER_PATH": EXTENSION}, PATIENCE)
            address = running.enter_context(lab)
        yield address


class Visit:
    """A page of JupyterLab, with what went wrong on it and what it asked of other machines."""

    def __init__(self, page, address):
        self.page, self.address = page, address
        self.errors, self.abroad = [], []
        page.set_default_timeout(1000 * PATIENCE)
        page.on("console", self._heard)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("request", self._asked)

    def open(self, notebook):
        """Open a notebook and wait until its kernel is ready."""
        path = notebook if "/" in notebook else f"notebooks/{notebook}"
        self.page.goto(self.address.format(path))
        self.page.wait_for_selector(".jp-NotebookPanel .jp-Cell")
        self.page.wait_for_selector(IDLE, state="attached")
        # the indicator is idle before there is a kernel, too
        self.page.get_by_text("| Idle").wait_for(state="attached")

    def turn_to(self, notebook):
        """Open a notebook by its path in the place of those that were, on the same page."""
        self.errors.clear()
        if self.page.url.startswith(BLANK):
            self.open(notebook)
        else:
            self.page.evaluate(TURN_TO, notebook)
            self.page.wait_for_selector(".jp-NotebookPanel .jp-Cell")
        self.settle()

    def settle(self):
        """Wait until the kernel has done what it was asked, and the page shows it."""
        self.page.evaluate(SETTLED)

    def run_all(self):
        """Run all cells of the notebook that is open, by the menu."""
        self.page.get_by_role("menuitem", name="Run", exact=True).click()
        self.page.locator(".lm-Menu-item").get_by_text("Run All Cells", exact=True).click()

    def run_all_and_wait(self):
        """Run all cells and wait until the last one is done: as long as one after another ends."""
        self.run_all()
        if not self.page.evaluate(HAS_CODE):
            return  # nothing ever waits
        left = self._cells_left(0, "raf")  # they might not wait for long
        while left > 0:
            left = self._cells_left(left, SELDOM)
        self.page.wait_for_selector(IDLE, state="attached")

    def save(self):
        """Save the notebook and wait until it is."""
        with self.page.expect_response(_is_saved):  # the file is whole from then on
            self.page.keyboard.press("Control+s")
        self.wait_until_clean()

    def wait_until_clean(self):
        """Wait until the tab says that nothing is unsaved."""
        self.page.wait_for_selector(".jp-mod-current.jp-mod-dirty", state="detached")

    @property
    def faults(self):
        """Errors of the page, but for those of a busy machine and of kernels that were ended."""
        return [error for error in self.errors if BUSY not in error and ENDED not in error]

    @property
    def is_dirty(self):
        """bool, whether the tab says that something is unsaved."""
        return self.page.locator(".lm-TabBar-tab.jp-mod-dirty").count() > 0

    def look_through(self):
        """Scroll through the notebook, so that all of it is laid out."""
        assert self.page.evaluate(LOOK_THROUGH, 1000 * PATIENCE)

    def serious_faults(self):
        """Faults of accessibility in the notebook's own area, serious or critical, by axe-core.

        Returns
        -------
        list of str, the rule and where it is broken
        """
        self.look_through()
        found = Axe().run(
            self.page,
            context=".jp-NotebookPanel .jp-WindowedPanel-viewport",
            options={"resultTypes": ["violations"]},
        )
        return [
            f"{broken['id']}: {node['html'][:200]}"
            for broken in found.response["violations"]
            if broken["impact"] in ("serious", "critical")
            for node in broken["nodes"]
            # a long line of code scrolls with the cursor, once Enter has led into the editor
            if "cm-scroller" not in node["html"]
        ]

    def run(self, cell):
        """Run a cell, given by its position, and wait until it is done.

        Returns
        -------
        Locator of the cell
        """
        place = self.page.locator(".jp-Cell").nth(cell)
        prompt = place.locator(".jp-InputPrompt")
        before = prompt.text_content()
        place.locator(".cm-content").click()
        self.page.keyboard.press("Control+Enter")
        self.page.wait_for_function(
            "([prompt, before]) => ![before, '[*]:'].includes(prompt.textContent)",
            arg=[prompt.element_handle(), before],
        )
        return place

    def _cells_left(self, before, polling):
        """How many cells wait or run, once that is another number than before."""
        changed = self.page.wait_for_function(CELLS_LEFT, arg=before, polling=polling)
        return changed.json_value()[0]

    def _heard(self, message):
        if message.type == "error":
            self.errors.append(message.text)

    def _asked(self, request):
        local = ("http://127.0.0.1:", "http://localhost:", "data:", "blob:")
        if not request.url.startswith(local):
            self.abroad.append(request.url)


def _is_saved(response):
    return response.request.method == "PUT" and "/api/contents/" in response.url
