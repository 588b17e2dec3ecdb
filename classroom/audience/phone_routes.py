"""HTTP routes of the phones: page, state, slides with their pictures, and votes."""

from tornado.web import HTTPError

from slamlab.live.web_server.http_server import ProtectedHandler
from slamlab.live.web_server.public_routes import public_routes, static_files

PAGE = {
    "/": ("index.html", "text/html; charset=utf-8"),
    "/phone.js": ("phone.js", "text/javascript; charset=utf-8"),
    "/phone.css": ("phone.css", "text/css; charset=utf-8"),
    "/favicon.ico": ("icon.svg", "image/svg+xml"),
}
WAITING = 25.0  # long polling: how long a phone waits for a change [s]


class LectureHandler(ProtectedHandler):
    def initialize(self, lecture):
        self._lecture = lecture


class State(LectureHandler):
    """State of the lecture, sent when it is newer than the version on the phone."""

    async def get(self, version):
        await self._lecture.newer_than(int(version), WAITING)
        await self.respond(self._lecture.state(self.client))


class ShownSlide(LectureHandler):
    async def get(self, number):
        slide = self._lecture.slides.get(int(number))
        if slide is None:
            raise HTTPError(404)
        await self.respond({"place": slide.place, "html": slide.html, "version": slide.version})


class Picture(LectureHandler):
    async def get(self, name):
        picture = self._lecture.picture(name)
        if picture is None:
            raise HTTPError(404)
        kind, content = picture
        await self.respond(content, kind)


class Vote(LectureHandler):
    async def post(self):
        vote, poll = self.json_body(), self._lecture.poll
        if poll is None or vote.get("poll") != poll.number or not poll.is_open:
            raise HTTPError(409)
        try:
            poll.vote(self.client, vote.get("answer"))
        except ValueError:
            raise HTTPError(400) from None
        await self.respond({"mine": poll.vote_of(self.client)})


def routes(lecture):
    arguments = {"lecture": lecture}
    return [
        *public_routes(static_files("classroom.audience", PAGE)),
        (r"/state/([0-9]{1,9})", State, arguments),
        (r"/slide/([0-9]{1,3})", ShownSlide, arguments),
        (r"/picture/([0-9a-f]{32})", Picture, arguments),
        (r"/vote", Vote, arguments),
    ]
