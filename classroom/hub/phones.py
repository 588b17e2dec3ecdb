"""Jupyter server extension: phones reach the user's audience server without an account.

Only ``class/`` is public. A request is passed on without the user's rights, and with no header
that the audience server does not need."""

import json
import re

from jupyter_server.auth.decorator import allow_unauthenticated
from tornado.httpclient import HTTPRequest
from tornado.simple_httpclient import SimpleAsyncHTTPClient
from tornado.web import HTTPError, RequestHandler, stream_request_body

from classroom.audience.server import COOKIE
from classroom.audience.server_start import state_file
from slamlab.live.web_server.http_server import CLIENT, ServerLimits

PASSED_ON = ("Host", "Origin", "Sec-Fetch-Site", "Content-Type")
NOT_RETURNED = ("Connection", "Content-Length", "Date", "Transfer-Encoding")
PATH = re.compile(r"/[\w./-]*", re.ASCII)
VALUE = re.compile(r"[\w-]{1,64}", re.ASCII)
MAX_PHONES = 1000  # that wait for an answer at the same time
TIMEOUT = 60.0  # [s]; a phone waits 25 s for a change of the slide


@stream_request_body
class Phones(RequestHandler):  # no JupyterHandler: it never asks who is logged in
    """Pass a phone's request to the audience server that runs for this user."""

    def initialize(self, prefix, client):
        self._prefix, self._client, self._body = prefix, client, b""

    def prepare(self):
        self.request.connection.set_max_body_size(ServerLimits().body)

    def data_received(self, chunk):
        self._body += chunk

    def check_xsrf_cookie(self):
        """Accept every request: the audience server compares its Origin."""

    @allow_unauthenticated
    async def get(self):
        path = self.request.path.removeprefix(self._prefix)
        if not path:
            self.redirect(f"{self._prefix}/")
            return
        try:
            port = json.loads(state_file().read_text())["ports"]["phones"]
            if not PATH.fullmatch(path):
                raise ValueError
        except (OSError, ValueError, KeyError):
            raise HTTPError(404) from None
        asked = HTTPRequest(
            f"http://127.0.0.1:{port}{path}",
            method=self.request.method,
            headers=self._headers_of_phone(),
            body=self._body if self.request.method == "POST" else None,
            follow_redirects=False,
            decompress_response=False,
            request_timeout=TIMEOUT,
        )
        try:
            answer = await self._client.fetch(asked, raise_error=False)
        except OSError:  # the lecture has ended
            raise HTTPError(404) from None
        self.clear()
        self.clear_header("Server")
        self.set_status(answer.code, answer.reason)
        for name, value in answer.headers.get_all():
            if name not in NOT_RETURNED:
                self.set_header(name, value)
        await self.finish(answer.body)

    head = post = get

    def _headers_of_phone(self):
        sent = self.request.headers
        headers = {name: sent[name] for name in PASSED_ON if name in sent}
        cookie = self.get_cookie(COOKIE, "")
        if VALUE.fullmatch(cookie):
            headers["Cookie"] = f"{COOKIE}={cookie}"
        # each proxy appends the address from which it was called
        forwarded = map(str.strip, sent.get("X-Forwarded-For", "").split(","))
        outside = [address for address in forwarded if address not in ("", "127.0.0.1", "::1")]
        return headers | {CLIENT: (outside or [self.request.remote_ip])[-1]}

    def log_exception(self, *_):
        """Log nothing: requests are private."""


def _jupyter_server_extension_points():
    return [{"module": "classroom.hub.phones"}]


def _load_jupyter_server_extension(app):
    prefix = app.web_app.settings["base_url"].rstrip("/") + "/class"
    client = SimpleAsyncHTTPClient(force_instance=True, max_clients=MAX_PHONES)
    arguments = {"prefix": prefix, "client": client}
    app.web_app.add_handlers(".*", [(rf"{re.escape(prefix)}(?:/.*)?", Phones, arguments)])
