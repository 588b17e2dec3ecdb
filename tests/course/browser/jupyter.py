"""Pages of JupyterLab for tests; browser and JupyterLab are those of rehearsals."""

import os
from contextlib import ExitStack, contextmanager
from unittest import mock

from classroom.lecturing import headless
from classroom.lecturing.headless import Unavailable, chromium
from course.source import ROOT
from tests.course.browser.promises import promised
from tests.course.browser.watching import SERIOUS, faults
from tests.timeouts import PATIENCE

__all__ = ["Unavailable", "Visit", "chromium", "jupyterlab"]
EXTENSION = ROOT / "labextension" / "share" / "jupyter"
IDLE = ".jp-Notebook-ExecutionIndicator[data-status=idle]"  # hidden on a narrow page
# anywidget gives up after two seconds, on a busy machine: the cell run again shows the widget
BUSY = "[anywidget] Failed to initialize model."
# JupyterLab asks a kernel that is being ended for its breakpoints
ENDED = "Could not restore the debugger state"
# JupyterLab removes a cell from its windowed list a second time; its own code recovers
TWICE = "Failed to execute 'removeChild' on 'Node'"
OURS = "blob:", "/extensions/slamlab/"  # addresses of the views' modules and of the extension

# a cell that was never visible has no layout, and further cells appear with a delay
LOOK_THROUGH = """async () => {
    const { widgets } = window.jupyterapp.shell.currentWidget.content;
    const seen = new Set();
    while (seen.size < widgets.length) {
        const cells = [...document.querySelectorAll(".jp-Cell")];
        const next = cells.find((one) => !seen.has(one)) ?? cells.at(-1);
        next.scrollIntoView();
        for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
        seen.add(next);
        for (const cell of cells) {
            const { top, bottom } = cell.getBoundingClientRect();
            if (bottom > 0 && top < innerHeight) seen.add(cell); // laid out as a whole
        }
    }
    return true;
}"""

# from the command on that runs cells to its end; a run may be over before anybody looks
RUN_COMMAND = """(command) => {
    const { commands } = window.jupyterapp;
    const run = (window.slamlabRun = { ended: false });
    const heard = (_, { id, result }) => {
        if (id != command) return;
        commands.commandExecuted.disconnect(heard);
        const end = () => { run.ended = true; };
        result.then(end, end);
    };
    commands.commandExecuted.connect(heard);
}"""
CELLS_LEFT = """(before) => {
    const prompts = [...document.querySelectorAll(".jp-InputPrompt")];
    const left = prompts.filter((prompt) => prompt.textContent == "[*]:").length;
    const { ended } = window.slamlabRun;
    return (ended || left != before) && { ended, left };
}"""
BLANK = "about:"  # of a fresh page
SELDOM = 200  # [ms]; asked for at every frame, the page would be repainted at every frame

# JupyterLab has written what it knows of the kernel
KNOWN = """async () => {
    const { context, sessionContext } = window.jupyterapp.shell.currentWidget;
    await Promise.all([context.ready, sessionContext.ready]);
    const { kernel } = sessionContext.session;
    await Promise.all([kernel.info, kernel.spec]);
    return true;
}"""
# what the kernel was asked before is shown
SETTLED = """async () => {
    const { kernel } = window.jupyterapp.shell.currentWidget.sessionContext.session;
    await kernel.requestKernelInfo(); // answered after all that was sent before
    await new Promise(requestAnimationFrame);
    return true;
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
    return true;
}"""


@contextmanager
def jupyterlab(user_folder, port=0, **environment):
    """A JupyterLab with the extension as it stands here, not as it was installed."""
    # a test is no student, but these play one: their progress is kept
    student = {name: value for name, value in os.environ.items() if name != "PYTEST_VERSION"}
    with ExitStack() as running:
        with mock.patch.dict(os.environ, student, clear=True):
            places = environment | {"JUPYTER_PATH": EXTENSION}
            lab = headless.jupyterlab(user_folder, places, PATIENCE, port)
            address = running.enter_context(lab)
        yield address


class Visit:
    """A page of JupyterLab, with what went wrong on it and what it asked of other machines."""

    def __init__(self, page, address):
        self.page, self.address = page, address
        self.errors, self.foreign_requests = [], []
        page.set_default_timeout(1000 * PATIENCE)
        page.on("console", self._on_console)
        page.on("pageerror", self._on_page_error)
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
            self._promised(f"{notebook} in the place of what was open", TURN_TO, notebook)
            self.page.wait_for_selector(".jp-NotebookPanel .jp-Cell")
        self.settle()

    def settle(self):
        """Wait until the kernel has done what it was asked, and the page shows it."""
        self._promised("the notebook's file, session and kernel", KNOWN)
        self._promised("the kernel's answer to all it was asked", SETTLED)

    def run_all(self):
        """Run all cells of the notebook that is open, by the menu."""
        self.page.get_by_role("menuitem", name="Run", exact=True).click()
        self.page.locator(".lm-Menu-item").get_by_text("Run All Cells", exact=True).click()

    def run_all_and_wait(self):
        """Run all cells and wait until the last one is done: as long as one after another ends."""
        self.page.evaluate(RUN_COMMAND, "notebook:run-all-cells")
        self.run_all()
        run = {"ended": False, "left": 0}
        while not run["ended"]:
            run = self._promised("a cell to end", CELLS_LEFT, run["left"], polling=SELDOM)
        self.page.wait_for_selector(IDLE, state="attached")

    def save(self):
        """Save the notebook and wait until it is."""
        with self.page.expect_response(_is_saved):  # the file is whole from then on
            self.page.keyboard.press("Control+s")
        self.wait_until_clean()

    def wait_until_clean(self):
        """Wait until the tab shows that everything is saved."""
        self.page.wait_for_selector(".jp-mod-current.jp-mod-dirty", state="detached")

    @property
    def faults(self):
        """Errors of the page, but for those of a busy machine and of kernels that were ended."""
        return [error for error in self.errors if BUSY not in error and ENDED not in error]

    @property
    def is_dirty(self):
        """Return whether the tab shows unsaved changes."""
        return self.page.locator(".lm-TabBar-tab.jp-mod-dirty").count() > 0

    def look_through(self):
        """Scroll through the notebook, so that all of it is laid out."""
        self._promised("all cells to be laid out", LOOK_THROUGH)

    def serious_faults(self):
        """Faults of accessibility in the notebook's own area, serious or critical, by axe-core.

        What is not laid out is not looked at: ``look_through`` comes first.

        Returns
        -------
        list of str, the rule and where it is broken
        """
        viewport = ".jp-NotebookPanel .jp-WindowedPanel-viewport"
        # a long line of code scrolls with the cursor, once Enter has led into the editor
        return faults(self.page, viewport, SERIOUS, but="cm-scroller")

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

    def _promised(self, what, script, arg=None, **more):
        return promised(self.page, what, script, arg, **more)

    def _on_console(self, message):
        # Jupyter's list of kernels fails while one starts, and JupyterLab asks for it again
        starting = "500" in message.text and "/api/kernels?" in message.location["url"]
        if message.type == "error" and not starting:
            self.errors.append(message.text)

    def _on_page_error(self, error):
        ours = any(place in (error.stack or "blob:") for place in OURS)
        if ours or TWICE not in error.message:
            self.errors.append(f"{error.message}\n{error.stack}")

    def _asked(self, request):
        local = ("http://127.0.0.1:", "http://localhost:", "data:", "blob:")
        if not request.url.startswith(local):
            self.foreign_requests.append(request.url)


def _is_saved(response):
    return response.request.method == "PUT" and "/api/contents/" in response.url
