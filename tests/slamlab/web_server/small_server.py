"""A small server with a protected, a public, a large and a WebSocket route."""

import contextlib
import functools

from tornado.websocket import WebSocketHandler

from slamlab.live.web_server import http_server
from slamlab.live.web_server.sessions import Sessions
from tests.slamlab.web_server.client import Client, run

METHODS = ["GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS"]
HANDSHAKE = {
    "Upgrade": "websocket",
    "Connection": "Upgrade",
    "Sec_WebSocket_Version": "13",
    "Sec_WebSocket_Key": "dGhlIHNhbXBsZSBub25jZQ==",
}


class Echo(http_server.ProtectedHandler):
    """A protected route, which answers every method with the request's body."""

    async def get(self):
        await self.respond({"inside": True})

    async def post(self):
        await self.respond(self.json_body())

    head = delete = patch = get
    put = post


class Open(Echo):
    is_public = True


class Socket(http_server.ProtectedHandler, WebSocketHandler):
    """A WebSocket that echoes messages."""

    def open(self):
        self.write_message("inside")

    def on_message(self, message):
        self.write_message(message)


class Large(http_server.ProtectedHandler):
    """A response too large for any buffer."""

    async def get(self):
        await self.respond(bytes(30_000_000), "image/png")


ROUTES = [(r"/inside", Echo), (r"/open", Open), (r"/socket", Socket), (r"/large", Large)]


@contextlib.contextmanager
def running_server(access, origin=None, **bounds):
    made = http_server.AccessControl(access, origin, http_server.ServerLimits(**bounds))
    server, port = http_server.listen(ROUTES, made)
    try:
        yield Client(port)
    finally:
        server.stop()


def in_a_loop(test):
    @functools.wraps(test)
    def in_it(**fixtures):
        run(test(**fixtures))

    return in_it


def logged_in(sessions, client):
    client.cookie = f"{sessions.name}={sessions.log_in(sessions.token, '127.0.0.1')}"
    return client


@contextlib.contextmanager
def inside(**bounds):
    """A client of a running server that has logged in."""
    sessions = Sessions("test")
    with running_server(sessions, **bounds) as client:
        yield logged_in(sessions, client)


HOSTS = ["localhost:{}", "evil.example", "127.0.0.1", "127.0.0.1:1", "127.0.0.2:{}"]
HOSTS += ["evil.example:{}", ""]
FOREIGN = ["http://evil.example", "null", "http://127.0.0.1"]
FOREIGN += ["https://{}", "http://{}.evil.example", "http://{}/"]
PATHS = ["/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/open/../inside"]
PATHS += ["/open%00", "/phone.js/..", "/.git/config", "/open/", "http://evil.example/open", "*"]
PATHS += ["/open\\..\\x"]
