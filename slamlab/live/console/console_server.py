"""Server of the web console: routes, WebSocket, start and end; commands from the terminal."""

import asyncio
import contextlib
import json
import logging
import secrets
import sys
import threading
from importlib.resources import files

from slamlab.extras import needs
from slamlab.live.console.control_panel import TERMINAL, TICK
from slamlab.live.console.page_screens import PageScreen
from slamlab.live.player.script_bundle import HERE as PLAYER
from slamlab.live.player.script_bundle import LIVE, script
from slamlab.live.web_server import http_server, stop_signals
from slamlab.live.web_server.public_routes import public_routes
from slamlab.live.web_server.rate_limits import Rate, TokenBucket
from slamlab.live.web_server.sessions import Sessions

with needs("live"):
    from tornado.websocket import WebSocketClosedError, WebSocketHandler

MESSAGE_RATE = Rate(600, 300)  # of a page, which acknowledges every frame
TRY_AGAIN_LATER = 1013  # WebSocket close code


class Socket(http_server.ProtectedHandler, WebSocketHandler):
    """WebSocket of a page: it sends frames and state, and receives commands and
    acknowledgements.
    """

    def initialize(self, panel):
        self._panel, self._shown = panel, None
        self.screen = PageScreen(self._send)
        self._messages = TokenBucket(MESSAGE_RATE)

    def open(self):
        self.set_nodelay(True)
        if not self._panel.screens.add(self.screen):
            self.close(TRY_AGAIN_LATER, "Too many pages are open.")
            return
        self._panel.sockets.add(self)
        self.send_state()

    def on_message(self, message):
        if not self._messages.take():
            self.close()
            return
        try:
            content = json.loads(message)
            kind = content["kind"]
        except (ValueError, TypeError, KeyError, RecursionError):
            return
        try:
            self._handle(kind, content)
        except ValueError as error:
            self._send_json({"kind": "answer", "text": str(error), "refused": True})
        self._panel.changed()

    def on_close(self):
        self._panel.sockets.discard(self)
        self._panel.screens.remove(self.screen)
        self._panel.leave(self.screen)

    def send_state(self):
        state = self._panel.state(self.screen)
        if state != self._shown:
            self._shown = state
            self._send_json(state)

    def _handle(self, kind, content):
        panel, screen = self._panel, self.screen
        match kind, content:
            case "ready", {"calm": bool(calm)}:
                panel.screens.start(screen, calm)
            case "drawn", {"number": int(number)}:
                screen.acknowledge(number)
            case "renew", _:
                panel.renew(screen)
            case (("key" | "press"), {"name": str(name)}):
                self._answer(panel.press(screen, name))
            case "line", {"text": str(text)}:
                self._answer(panel.execute(screen, text))
            case "speed", {"value": int(speed)}:
                panel.set_speed(screen, speed)

    def _answer(self, text):
        self._send_json({"kind": "answer", "text": text, "refused": False})

    def _send_json(self, content):
        self._send(json.dumps(content))

    def _send(self, message):
        with contextlib.suppress(WebSocketClosedError):  # on_close follows
            self.write_message(message, binary=isinstance(message, bytes))


def routes(panel):
    folder = files("slamlab.live.console") / "page"
    styles = (PLAYER / "player.css").read_bytes() + (folder / "console.css").read_bytes()
    contents = {
        "/": ((folder / "console.html").read_bytes(), "text/html; charset=utf-8"),
        "/console.js": (
            script(LIVE, folder / "console.js").encode(),
            "text/javascript; charset=utf-8",
        ),
        "/console.css": (styles, "text/css; charset=utf-8"),
        "/favicon.ico": ((folder / "robot.svg").read_bytes(), "image/svg+xml"),
    }
    return [*public_routes(contents), (r"/socket", Socket, {"panel": panel})]


async def serve(panel, port=0, started=lambda address: None):
    """Serve a control panel until its run ends, and call ``started(address)`` with the page's
    address. Port 0 selects any free port. OSError: the port is not free.
    """
    for name in ("tornado", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # requests are private
    # browsers send a cookie to every port of an address, so its name identifies the server
    sessions = Sessions(f"slamlab-live-{secrets.token_hex(4)}")
    access_control = http_server.AccessControl(sessions)
    server, port = http_server.listen(routes(panel), access_control, port=port)
    address = access_control.publish(f"proxy/{port}/") or f"http://127.0.0.1:{port}/"
    stop_signals.stop_on_signals(panel.ended.set)
    try:
        started(f"{address}#{sessions.token}")
        while not panel.ended.is_set():
            panel.tick()
            panel.changed()
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(panel.ended.wait(), TICK)
    finally:
        panel.loop.pause()
        server.stop()
        for socket in tuple(panel.sockets):
            socket.close(1001, "The program has ended.")
        await asyncio.sleep(TICK)  # for the pages to receive it


def read_terminal(panel, loop):
    """Start a thread that executes each typed line in an event loop and prints the answer."""

    def execute(line):
        try:
            message = panel.execute(TERMINAL, line)
        except ValueError as error:
            message = str(error)
        print(message, flush=True)

    def read():
        for line in sys.stdin:
            if loop.is_closed():
                return
            loop.call_soon_threadsafe(execute, line)

    threading.Thread(target=read, name="reads the terminal", daemon=True).start()
