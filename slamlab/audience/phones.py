"""What phones may ask for: the page, the state, a slide shown, a picture of it; and their vote."""

from tornado.web import HTTPError

from slamlab.listening.entrance import open_routes, shipped
from slamlab.listening.guard import Guarded

PAGE = {
    "/": ("index.html", "text/html; charset=utf-8"),
    "/phone.js": ("phone.js", "text/javascript; charset=utf-8"),
    "/phone.css": ("phone.css", "text/css; charset=utf-8"),
    "/favicon.ico": ("icon.svg", "image/svg+xml"),
}
WAITING = 25.0  # [s], of a phone for something new


class State(Guarded):
    """The state, once it is newer than the one that the phone knows."""

    def initialize(self, lecture):
        self._lecture = lecture

    async def get(self, known):
        await self._lecture.newer_than(int(known), WAITING)
        await self.give(self._lecture.state(self.client))


class ShownSlide(Guarded):
    """A slide that was shown; nothing is known of the others."""

    def initialize(self, lecture):
        self._lecture = lecture

    async def get(self, number):
        slide = self._lecture.slides.get(int(number))
        if slide is None:
            raise HTTPError(404)
        await self.give({"place": slide.place, "html": slide.html, "version": slide.version})


class Picture(Guarded):
    """A picture of a slide that was shown."""

    def initialize(self, lecture):
        self._lecture = lecture

    async def get(self, name):
        found = self._lecture.picture(name)
        if found is None:
            raise HTTPError(404)
        kind, content = found
        await self.give(content, kind)


class Vote(Guarded):
    """One choice or one finite number."""

    def initialize(self, lecture):
        self._lecture = lecture

    async def post(self):
        said, poll = self.body(), self._lecture.poll
        if poll is None or said.get("poll") != poll.number or not poll.is_open:
            raise HTTPError(409)
        try:
            poll.vote(self.client, said.get("answer"))
        except ValueError:
            raise HTTPError(400) from None
        await self.give({"mine": poll.vote_of(self.client)})


def routes(lecture):
    """The phones' whole table of routes.

    Parameters
    ----------
    lecture : Lecture

    Returns
    -------
    list of tornado's routes
    """
    known = {"lecture": lecture}
    return [
        *open_routes(shipped("slamlab.audience", PAGE)),
        (r"/state/([0-9]{1,9})", State, known),
        (r"/slide/([0-9]{1,3})", ShownSlide, known),
        (r"/picture/([0-9a-f]{32})", Picture, known),
        (r"/vote", Vote, known),
    ]
