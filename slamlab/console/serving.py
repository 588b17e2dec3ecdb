"""Serve a desk to pages of this machine: routes, the socket, start and end."""

import asyncio
import contextlib
import json
import logging
import secrets
import time
from importlib.resources import files

from tornado.websocket import WebSocketClosedError, WebSocketHandler

from slamlab.console.desk import TICK
from slamlab.console.watchers import PageScreen
from slamlab.listening import guard
from slamlab.listening.door import Door
from slamlab.listening.ending import end_on_signals
from slamlab.listening.entrance import open_routes
from slamlab.listening.rates import Bucket, Rate
from slamlab.views.player.library import HERE as PLAYER
from slamlab.views.player.library import LIVE, script

SPOKEN = Rate(600, 300)  # messages of a page: it acknowledges every frame
TOO_MANY = 1013  # the socket's word for "try again later"


class Socket(guard.Guarded, WebSocketHandler):
    """A page's socket: frames and the state go out, words and acknowledgements come in."""

    def initialize(self, desk):
        self._desk, self._shown = desk, None
        self.screen = PageScreen(self._send)
        self._spoken = Bucket(SPOKEN, time.monotonic)

    def open(self):
        self.set_nodelay(True)
        if not self._desk.watchers.join(self.screen):
            self.close(TOO_MANY, "Too many pages look already.")
            return
        self._desk.sockets.add(self)
        self.tell_state()

    def on_message(self, message):
        if not self._spoken.take():
            self.close()
            return
        try:
            said = json.loads(message)
            kind = said["kind"]
        except (ValueError, TypeError, KeyError, RecursionError):
            return
        try:
            self._hear(kind, said)
        except ValueError as error:
            self._tell({"kind": "answer", "text": str(error), "refused": True})
        self._desk.changed()

    def on_close(self):
        self._desk.sockets.discard(self)
        self._desk.watchers.leave(self.screen)
        self._desk.leave(self.screen)

    def tell_state(self):
        """Tell the page what has changed beside the picture."""
        state = self._desk.state(self.screen)
        if state != self._shown:
            self._shown = state
            self._tell(state)

    def _hear(self, kind, said):
        desk, screen = self._desk, self.screen
        match kind, said:
            case "ready", {"calm": bool(calm)}:
                desk.watchers.begin(screen, calm)
            case "drawn", {"number": int(number)}:
                screen.acknowledge(number)
            case "renew", _:
                desk.renew(screen)
            case (("key" | "press"), {"name": str(name)}):
                self._answer(desk.press(screen, name))
            case "line", {"text": str(text)}:
                self._answer(desk.execute(screen, text))
            case "speed", {"value": int(speed)}:
                desk.set_speed(screen, speed)

    def _answer(self, text):
        self._tell({"kind": "answer", "text": text, "refused": False})

    def _tell(self, said):
        self._send(json.dumps(said))

    def _send(self, message):
        with contextlib.suppress(WebSocketClosedError):  # it has gone, on_close comes
            self.write_message(message, binary=isinstance(message, bytes))


def routes(desk):
    """Table of routes.

    Parameters
    ----------
    desk : Desk

    Returns
    -------
    list of tornado's routes
    """
    folder = files("slamlab.console") / "page"
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
    return [*open_routes(contents), (r"/socket", Socket, {"desk": desk})]


async def serve(desk, port=0, begun=lambda address: None):
    """Serve a desk on this machine until it is over.

    Parameters
    ----------
    desk : Desk
    port : int, any free one by default
    begun : callable(str), told the address with its token as soon as pages can open it

    Raises
    ------
    OSError : the port is taken
    """
    for name in ("tornado", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # who asked for what is not told
    # a cookie is sent to every port of an address: its name says whose it is
    door = Door(f"slamlab-live-{secrets.token_hex(4)}")
    server, port = guard.listen(routes(desk), guard.Guard(door), port=port)
    end_on_signals(desk.over.set)
    try:
        begun(f"http://127.0.0.1:{port}/#{door.token}")
        while not desk.over.is_set():
            desk.tick()
            desk.changed()
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(desk.over.wait(), TICK)
    finally:
        desk.loop.pause()
        server.stop()
        for socket in tuple(desk.sockets):
            socket.close(1001, "The program has ended.")
        await asyncio.sleep(TICK)  # for that to be heard
