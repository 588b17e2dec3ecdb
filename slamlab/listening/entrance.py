"""Route by which one comes in: a token or a code, changed into a cookie."""

from tornado.web import HTTPError

from slamlab.listening.door import Refused
from slamlab.listening.guard import Guarded


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
