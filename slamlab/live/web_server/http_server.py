"""HTTP server with access control of every request and WebSocket. The server accepts only requests
whose Host is the address where they arrived, or that of the proxy in front of the server (against
DNS rebinding), with the expected Origin, an authenticated client, and a rate within the limit. Only
the paths in a fixed table exist, and nothing is logged.
"""

import asyncio
import json
import os
from typing import NamedTuple
from urllib.parse import urlsplit

from slamlab.extras import needs
from slamlab.live.web_server.connection_limits import ConnectionLimits, raise_file_limit
from slamlab.live.web_server.rate_limits import ClientBuckets, Rate

with needs("live"):
    from tornado.httpserver import HTTPServer
    from tornado.iostream import StreamClosedError
    from tornado.netutil import bind_sockets
    from tornado.web import Application, HTTPError, RequestHandler

HEADERS = {
    "Content-Security-Policy": "default-src 'self'; frame-ancestors 'none'; base-uri 'none'; "
    "form-action 'none'; object-src 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
}
SAFE_METHODS = ("GET", "HEAD")
HUB = "JUPYTERHUB_PUBLIC_URL"  # variable with the public address of the user's own server
CLIENT = "X-Real-IP"  # header in which a proxy states its client's address
ERRORS = {
    400: "The request cannot be read.",
    403: "Access denied: the code or address is wrong, or the request is not from this page.",
    404: "This page does not exist.",
    429: "Too many requests: wait a moment.",
    503: "The server is full.",
}


class ServerLimits(NamedTuple):
    """Limits of sizes [bytes], timeouts [s] and rates."""

    header: int = 16_384
    body: int = 1024
    message: int = 1024  # of a WebSocket
    header_timeout: float = 15.0
    body_timeout: float = 15.0
    response_timeout: float = 60.0  # for a client to receive a response
    # Two hundred may log in at once from one address, with some five requests each.
    address: Rate = Rate(2500, 100)  # of anonymous requests
    all_addresses: Rate = Rate(5000, 500)
    client: Rate = Rate(60, 10)  # of authenticated requests
    all_clients: Rate = Rate(5000, 1500)


class AccessControl:
    """Access control of requests. ``authentication`` is a Sessions or a BearerToken; ``origin`` is
    the only accepted origin; None means the server's own origin.
    """

    public = urlsplit("")  # the address at which a proxy serves this server, see ``publish``

    def __init__(self, authentication, origin=None, limits=ServerLimits()):  # noqa: B008
        self.authentication, self.origin, self.limits = authentication, origin, limits
        self.connections = ConnectionLimits(raise_file_limit())
        self._anonymous = ClientBuckets(limits.address, limits.all_addresses)
        self._authenticated = ClientBuckets(limits.client, limits.all_clients)

    def publish(self, path):
        """On a JupyterHub, accept only requests that arrive through the user's own server.

        Return the public address of ``path`` below that server, or "" elsewhere.
        """
        base = os.environ.get(HUB)
        if not base:
            return ""
        self.public, self.origin = urlsplit(base + path), None
        return base + path

    def authorise(self, handler):
        """Return the client of a ProtectedHandler's request, or None if anonymous; raise HTTPError
        403 or 429.
        """
        request = handler.request
        stream = request.connection.stream
        client = self.authentication.client(handler)
        if client is not None and not stream.closed():
            self.connections.authenticate(request.remote_ip, client, stream)
        buckets = self._anonymous if client is None else self._authenticated
        if not buckets.take(client or self.address(request)):
            raise HTTPError(429)
        own = self.public.netloc or _own_address(stream)
        if own is None or request.headers.get_list("Host") != [own]:
            raise HTTPError(403)
        if not self._has_expected_origin(request, own):
            raise HTTPError(403)
        if client is None and not (handler.is_public or self._is_preflight(request)):
            raise HTTPError(403)
        return client

    def address(self, request):
        """Return a client's address, which a proxy may state; only rate limits depend on it."""
        stated = request.headers.get(CLIENT, "") if self.public.netloc else ""
        return stated or request.remote_ip

    def _has_expected_origin(self, request, own):
        origins = request.headers.get_list("Origin")
        if self.origin is not None:
            return origins == [self.origin]
        if request.headers.get("Sec-Fetch-Site", "none") not in ("none", "same-origin"):
            return False
        # a browser sends no Origin when it only reads a page or a picture of the same origin
        reads = request.method in SAFE_METHODS and "Upgrade" not in request.headers
        scheme = self.public.scheme or "http"
        return origins == [f"{scheme}://{own}"] or (reads and not origins)

    def _is_preflight(self, request):
        return self.origin is not None and request.method == "OPTIONS"


def _own_address(stream):
    if stream.socket is None:
        return None
    host, port, *_ = stream.socket.getsockname()
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"


class ProtectedHandler(RequestHandler):
    """Request handler with access control; ``is_public`` accepts anonymous clients."""

    is_public = False

    def set_default_headers(self):
        self.clear_header("Server")
        for name, value in HEADERS.items():
            self.set_header(name, value)
        origin = self.settings["access_control"].origin
        if origin is not None:
            self.set_header("Access-Control-Allow-Origin", origin)
            self.set_header("Cross-Origin-Resource-Policy", "same-site")

    def prepare(self):
        self.client = self.settings["access_control"].authorise(self)

    def options(self, *_):
        """Answer a CORS preflight."""
        if self.settings["access_control"].origin is None:
            raise HTTPError(405)
        self.set_status(204)
        self.set_header("Access-Control-Allow-Methods", "GET, PUT, POST, DELETE")
        self.set_header("Access-Control-Allow-Headers", "Authorization, Content-Type")
        self.set_header("Access-Control-Allow-Private-Network", "true")
        self.set_header("Access-Control-Max-Age", "600")

    def json_body(self):
        """Return the JSON object in the request's body. HTTPError 400: there is no object."""
        kind = self.request.headers.get("Content-Type", "").partition(";")[0].strip()
        try:
            content = json.loads(self.request.body) if kind == "application/json" else None
        except (ValueError, RecursionError):
            content = None
        if not isinstance(content, dict):
            raise HTTPError(400)
        return content

    async def respond(self, content, kind="application/json"):
        """Send bytes or JSON; close the connection if the client does not receive it in time."""
        self.set_header("Content-Type", kind)
        if not isinstance(content, bytes):
            content = json.dumps(content, allow_nan=False).encode()
        timeout = self.settings["access_control"].limits.response_timeout
        stream = self.request.connection.stream
        try:
            await asyncio.wait_for(self.finish(content), timeout)
        except TimeoutError:
            stream.close()
        except StreamClosedError:
            pass  # the client has closed the connection

    def write_error(self, status_code, **_):
        if status_code == 429:
            self.set_header("Retry-After", "2")
            self.set_header("Connection", "close")
        self.finish({"error": ERRORS.get(status_code, "The request cannot be served.")})

    def compute_etag(self):
        return None  # responses are not cached

    def log_exception(self, *_):
        """Log nothing: requests are private."""


class UnknownPath(ProtectedHandler):
    """Handler of every path that is not in the table."""

    def prepare(self):
        super().prepare()
        raise HTTPError(404)


class StaticFile(ProtectedHandler):
    """Handler of a public static file."""

    is_public = True

    def initialize(self, content, kind):
        self._content, self._kind = content, kind

    async def get(self):
        await self.respond(self._content, self._kind)


class _LimitedServer(HTTPServer):
    connections = None

    def handle_stream(self, stream, address):
        self.connections.add(address[0], stream)
        super().handle_stream(stream, address)


def listen(routes, access_control, host="127.0.0.1", port=0):
    """Start a server on an address of this machine, in a running event loop; return the HTTPServer
    and its port. ``routes`` lead to ProtectedHandlers. Port 0 selects any free port. OSError: the
    port is not free.
    """
    limits = access_control.limits
    application = Application(
        routes,
        access_control=access_control,
        default_handler_class=UnknownPath,
        log_function=lambda handler: None,
        websocket_max_message_size=limits.message,
    )
    server = _LimitedServer(
        application,
        max_header_size=limits.header,
        max_body_size=limits.body,
        max_buffer_size=limits.header + limits.body,
        idle_connection_timeout=limits.header_timeout,
        body_timeout=limits.body_timeout,
    )
    server.connections = access_control.connections
    sockets = bind_sockets(port, host, backlog=1024)
    server.add_sockets(sockets)
    return server, sockets[0].getsockname()[1]
