"""Routes open to everybody: what is shipped, and a token or a code changed into a cookie."""

from importlib.resources import files

from tornado.web import HTTPError

from slamlab.listening.door import Refused
from slamlab.listening.guard import Fixed, Guarded


class Enter(Guarded):
    """The token or the code, changed into a cookie."""

    is_open = True

    async def post(self):
        door = self.settings["guard"].access
        given = self.body().get("key")
        if not isinstance(given, str):
            raise HTTPError(400)
        if self.client is None:
            try:
                cookie = door.enter(given, self.request.remote_ip)
            except Refused as refused:
                raise HTTPError(refused.status) from None
            self.set_cookie(door.name, cookie, httponly=True, samesite="Strict", path="/")
        await self.give({})


def shipped(package, listed):
    """Contents of a package's page, read once.

    Parameters
    ----------
    package : str, which has a folder ``page``
    listed : dict, path of a request to (name of a file in it, content type)

    Returns
    -------
    dict, path to (bytes, content type)
    """
    folder = files(package) / "page"
    return {path: ((folder / name).read_bytes(), kind) for path, (name, kind) in listed.items()}


def open_routes(contents):
    """Routes that are open to everybody: what is shipped, and the entrance.

    Parameters
    ----------
    contents : dict, path to (bytes, content type)

    Returns
    -------
    list of tornado's routes
    """
    page = [
        (path, Fixed, {"content": content, "kind": kind})
        for path, (content, kind) in contents.items()
    ]
    return [*page, (r"/enter", Enter)]
