"""The guard over every request and socket of whatever listens, and the listener itself.

A request gets on only if its Host is the address at which it arrived (so no name that leads here
by a trick of DNS does), its Origin is the one expected, and who asks is known and asks not too
often.
There is a fixed table of routes; nothing that a client sends is a path, and nothing is logged.
"""

import asyncio
import json
import time
from typing import NamedTuple

from tornado.httpserver import HTTPServer
from tornado.iostream import StreamClosedError
from tornado.netutil import bind_sockets
from tornado.web import Application, HTTPError, RequestHandler

from slamlab.listening.crowd import Crowd, files_to_open
from slamlab.listening.rates import Buckets, Rate

HEADERS = {
    "Content-Security-Policy": "default-src 'self'; frame-ancestors 'none'; base-uri 'none'; "
    "form-action 'none'; object-src 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
}
READING = ("GET", "HEAD")
WORDS = {
    400: "this cannot be read",
    403: "not from here, or not without the code",
    404: "there is nothing here",
    429: "too much at once: wait a little",
    503: "no more can come in",
}


class Bounds(NamedTuple):
    """Bounds of sizes [bytes], waiting [s] and rates."""

    header: int = 16_384
    body: int = 1024
    message: int = 1024  # of a socket
    silence: float = 15.0  # until a request's headers are there
    slowness: float = 15.0  # until its body is there
    taking: float = 60.0  # until the answer is taken
    # A class of 200 may come in at once behind one address, with some five requests each.
    stranger: Rate = Rate(2500, 100)
    strangers: Rate = Rate(5000, 500)
    client: Rate = Rate(60, 10)
    clients: Rate = Rate(5000, 1500)


class Guard:
    """What is asked of a request before it gets on.

    Parameters
    ----------
    access : Door or Key, whose ``client(handler)`` says who asks
    origin : str or None, the only origin that requests may come from; None is the listener's own
    bounds : Bounds
    clock : callable -> float [s]
    """

    def __init__(self, access, origin=None, bounds=Bounds(), clock=time.monotonic):  # noqa: B008
        self.access, self.origin, self.bounds = access, origin, bounds
        self.crowd = Crowd(files_to_open())
        self._strangers = Buckets(bounds.stranger, bounds.strangers, clock)
        self._clients = Buckets(bounds.client, bounds.clients, clock)

    def admit(self, handler):
        """Let a request on.

        Parameters
        ----------
        handler : Guarded

        Returns
        -------
        str or None, the client, None for a stranger on an open route

        Raises
        ------
        HTTPError : 403 it must not, 429 too often
        """
        request = handler.request
        stream = request.connection.stream
        client = self.access.client(handler)
        if client is not None and not stream.closed():
            self.crowd.admit(request.remote_ip, client, stream)
        often = self._strangers if client is None else self._clients
        if not often.take(client or request.remote_ip):
            raise HTTPError(429)
        own = _own_address(stream)
        if own is None or request.headers.get_list("Host") != [own]:
            raise HTTPError(403)
        if not self._from_expected(request, own):
            raise HTTPError(403)
        if client is None and not (handler.is_open or self._is_preflight(request)):
            raise HTTPError(403)
        return client

    def _from_expected(self, request, own):
        origins = request.headers.get_list("Origin")
        if self.origin is not None:
            return origins == [self.origin]
        if request.headers.get("Sec-Fetch-Site", "none") not in ("none", "same-origin"):
            return False
        # a browser names no origin when a page or a picture of the same origin is only read
        reading = request.method in READING and "Upgrade" not in request.headers
        return origins == [f"http://{own}"] or (reading and not origins)

    def _is_preflight(self, request):
        return self.origin is not None and request.method == "OPTIONS"


def _own_address(stream):
    """Where a connection arrived: host and port; None if it is gone."""
    if stream.socket is None:
        return None
    host, port, *_ = stream.socket.getsockname()
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"


class Guarded(RequestHandler):
    """A route behind the guard; ``is_open`` for what a stranger may ask for."""

    is_open = False

    def set_default_headers(self):
        self.clear_header("Server")
        for name, value in HEADERS.items():
            self.set_header(name, value)
        origin = self.settings["guard"].origin
        if origin is not None:
            self.set_header("Access-Control-Allow-Origin", origin)
            self.set_header("Cross-Origin-Resource-Policy", "same-site")

    def prepare(self):
        self.client = self.settings["guard"].admit(self)

    def options(self, *_):
        """Answer a browser that asks beforehand what the expected origin may send."""
        if self.settings["guard"].origin is None:
            raise HTTPError(405)
        self.set_status(204)
        self.set_header("Access-Control-Allow-Methods", "GET, PUT, POST, DELETE")
        self.set_header("Access-Control-Allow-Headers", "Authorization, Content-Type")
        self.set_header("Access-Control-Allow-Private-Network", "true")
        self.set_header("Access-Control-Max-Age", "600")

    def body(self):
        """The JSON object that was sent.

        Returns
        -------
        dict

        Raises
        ------
        HTTPError : 400 it is none
        """
        kind = self.request.headers.get("Content-Type", "").partition(";")[0].strip()
        try:
            said = json.loads(self.request.body) if kind == "application/json" else None
        except (ValueError, RecursionError):
            said = None
        if not isinstance(said, dict):
            raise HTTPError(400)
        return said

    async def give(self, content, kind="application/json"):
        """Answer; whoever does not take the answer in time loses the connection.

        Parameters
        ----------
        content : bytes or what JSON holds
        kind : str, its media type
        """
        self.set_header("Content-Type", kind)
        if not isinstance(content, bytes):
            content = json.dumps(content, allow_nan=False).encode()
        taking = self.settings["guard"].bounds.taking
        stream = self.request.connection.stream
        try:
            await asyncio.wait_for(self.finish(content), taking)
        except TimeoutError:
            stream.close()
        except StreamClosedError:
            pass  # it has gone; nobody waits

    def write_error(self, status_code, **_):
        if status_code == 429:
            self.set_header("Retry-After", "2")
            self.set_header("Connection", "close")
        self.finish({"error": WORDS.get(status_code, "this cannot be done")})

    def compute_etag(self):
        return None  # nothing is kept

    def log_exception(self, *_):
        """Say nothing: what is asked is nobody's business."""


class Nothing(Guarded):
    """Every address that is not in the table."""

    def prepare(self):
        super().prepare()
        raise HTTPError(404)


class Fixed(Guarded):
    """A page, style or script that is shipped, for everybody."""

    is_open = True

    def initialize(self, content, kind):
        self._content, self._kind = content, kind

    async def get(self):
        await self.give(self._content, self._kind)


class _Listener(HTTPServer):
    crowd = None

    def handle_stream(self, stream, address):
        self.crowd.enter(address[0], stream)
        super().handle_stream(stream, address)


def listen(routes, guard, host="127.0.0.1", port=0):
    """Listen, within a running event loop of asyncio.

    Parameters
    ----------
    routes : list of tornado's routes, to handlers that are Guarded
    guard : Guard
    host : str, an address of this machine; "0.0.0.0" for all of them
    port : int, 0 for any that is free

    Returns
    -------
    (HTTPServer, int), which stops by ``stop()``, and the port

    Raises
    ------
    OSError : the port is taken, or the address is not this machine's
    """
    bounds = guard.bounds
    application = Application(
        routes,
        guard=guard,
        default_handler_class=Nothing,
        log_function=lambda handler: None,
        websocket_max_message_size=bounds.message,
    )
    server = _Listener(
        application,
        max_header_size=bounds.header,
        max_body_size=bounds.body,
        max_buffer_size=bounds.header + bounds.body,
        idle_connection_timeout=bounds.silence,
        body_timeout=bounds.slowness,
    )
    server.crowd = guard.crowd
    sockets = bind_sockets(port, host, backlog=1024)
    server.add_sockets(sockets)
    return server, sockets[0].getsockname()[1]
