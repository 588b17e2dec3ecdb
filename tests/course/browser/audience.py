"""The lecturer's page and the phones that follow a lecture."""

import contextlib
import http.server
import io
from pathlib import Path

from classroom.audience import server_start
from tests.course.browser.jupyter import EXTENSION
from tests.course.browser.watching import watch

LECTURE = EXTENSION / "labextensions" / "slamlab" / "static"


class Files(http.server.SimpleHTTPRequestHandler):
    """The extension's modules, and a deck that keeps the contract."""

    def guess_type(self, path):
        return "text/javascript" if str(path).endswith(".js") else super().guess_type(path)

    def translate_path(self, path):
        if path == "/":
            return str(Path(__file__).with_name("fake_deck.html"))
        return super().translate_path(path)

    def log_message(self, *_):
        pass


class Hall:
    """The lecturer's page and the phones that came in."""

    def __init__(self, browser, address):
        self.browser, self.errors, self.foreign_requests, self.contexts = browser, [], [], []
        self.deck = self._page({"viewport": {"width": 1280, "height": 720}})
        self.deck.expose_function("runInKernel", self._run)
        self.deck.goto(address)
        self.deck.wait_for_selector("body[data-ready]", state="attached")

    def _page(self, options):
        context = self.browser.new_context(**options)
        self.contexts.append(context)
        page = context.new_page()
        watch(page, ("http://127.0.0.1:",), self.errors, self.foreign_requests, console=False)
        return page

    def _run(self, program):
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(program, {})
        return printed.getvalue()

    def open(self):
        """Open the class on this machine alone."""
        self.deck.keyboard.press("a")
        self.deck.get_by_role("button", name="open on this machine only").click()
        self.deck.locator(".slamlab-class-code").wait_for()
        self.started = server_start.start(self.deck.url.rstrip("/"))

    def phone(self, width=390, **options):
        """A phone whose owner has typed the address."""
        page = self._page(
            {"viewport": {"width": width, "height": 780}, "has_touch": True} | options
        )
        address = self.started["addresses"][0]["address"]
        page.goto(address)
        return page

    def join(self, **options):
        """A phone whose owner has typed the code."""
        phone = self.phone(**options)
        phone.get_by_label("Code on the lecturer's screen").fill(self.started["code"].lower())
        phone.get_by_role("button", name="join").click()
        phone.get_by_text("Connected.").wait_for()
        return phone

    def ask(self, slide=2):
        """Hide what phones need to come in, and ask the class what stands on a slide."""
        self.deck.get_by_role("button", name="hide").click()
        self.go(slide)
        self.deck.get_by_role("button", name="ask the class").click()

    def go(self, slide, step=0):
        self.deck.evaluate("([slide, step]) => deck.go(slide, step)", [slide, step])

    def close(self):
        for context in self.contexts:
            context.close()
