"""Routes that require no login: static files, and the login itself."""

from importlib.resources import files

from slamlab.extras import needs
from slamlab.live.web_server.http_server import ProtectedHandler, StaticFile
from slamlab.live.web_server.sessions import LoginRefused

with needs("live"):
    from tornado.web import HTTPError


class Login(ProtectedHandler):
    """Login handler: exchanges a token or code for a session cookie."""

    is_public = True

    async def post(self):
        access_control = self.settings["access_control"]
        sessions, public = access_control.authentication, access_control.public
        key = self.json_body().get("key")
        if not isinstance(key, str):
            raise HTTPError(400)
        if self.client is None:
            try:
                cookie = sessions.log_in(key, access_control.address(self.request))
            except LoginRefused as refused:
                raise HTTPError(refused.status) from None
            attributes = {"httponly": True, "samesite": "Strict", "path": public.path or "/"}
            if public.scheme == "https":
                attributes["secure"] = True
            self.set_cookie(sessions.name, cookie, **attributes)
        await self.respond({})


def static_files(package, listed):
    """Read a package's folder ``page``; return {path: (bytes, content type)}. ``listed`` maps a
    path to (name of a file, content type).
    """
    folder = files(package) / "page"
    return {path: ((folder / name).read_bytes(), kind) for path, (name, kind) in listed.items()}


def public_routes(contents):
    """Return Tornado routes to contents, a dict as from :func:`static_files`, and to the login."""
    page = [
        (path, StaticFile, {"content": content, "kind": kind})
        for path, (content, kind) in contents.items()
    ]
    return [*page, (r"/login", Login)]
