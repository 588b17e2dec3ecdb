"""An audience server behind the route of a user's Jupyter server, as on a JupyterHub."""

import contextlib
import json
from types import SimpleNamespace
from unittest import mock

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application

from classroom.audience import phone_routes
from classroom.audience.server import COOKIE
from classroom.hub import phones
from slamlab.live.web_server import http_server
from slamlab.live.web_server.sessions import Sessions
from tests.classroom.audience.test_attacks import RunningLecture
from tests.slamlab.web_server.client import Client

BASE = "/user/ada/"


class ProxiedClient(Client):
    """A client that names the paths of the audience server as they are below the user's server."""

    async def ask(self, method, path, content=None, drop=(), **headers):
        return await super().ask(method, f"{BASE}class{path}", content, drop, **headers)


@contextlib.contextmanager
def published(routes, folder, sessions=None, **bounds):
    """Serve routes behind a user's server; yield the user's port and the sessions."""
    sessions = sessions or Sessions(COOKIE)
    sockets = bind_sockets(0, "127.0.0.1")
    port = sockets[0].getsockname()[1]
    access_control = http_server.AccessControl(sessions, None, http_server.ServerLimits(**bounds))
    server, inner = http_server.listen(routes, access_control)
    with mock.patch.dict("os.environ", {http_server.HUB: f"http://127.0.0.1:{port}{BASE}"}):
        access_control.publish("class")
    state = folder / "slamlab-audience.json"
    state.write_text(json.dumps({"ports": {"phones": inner}}))
    application = Application([], base_url=BASE)
    phones._load_jupyter_server_extension(SimpleNamespace(web_app=application))
    outer = HTTPServer(application)
    outer.add_sockets(sockets)
    try:
        with mock.patch.object(phones, "state_file", lambda: state):
            yield port, sessions
    finally:
        outer.stop()
        server.stop()


class ProxiedLecture(RunningLecture):
    """A lecture whose phones come through the user's server."""

    def __init__(self, folder):
        super().__init__()
        self.phone_server.stop()
        self._published = published(phone_routes.routes(self.lecture), folder, self.sessions)
        self.port, _ = self._published.__enter__()
        self.phone_server = SimpleNamespace(stop=lambda: self._published.__exit__(None, None, None))
