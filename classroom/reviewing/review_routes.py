"""HTTP server of the review page: its routes, start and end."""

import asyncio
import logging
import secrets

from tornado.web import HTTPError

from classroom.grading.database import GradebookError
from classroom.reviewing import manual_changes
from classroom.reviewing.class_overview import overview
from classroom.reviewing.similarity_view import pair_view, pairs_view
from classroom.reviewing.submission_view import submission_view
from classroom.reviewing.visible_text import visible
from slamlab.live.web_server import http_server, stop_signals
from slamlab.live.web_server.public_routes import public_routes, static_files
from slamlab.live.web_server.rate_limits import Rate
from slamlab.live.web_server.sessions import Sessions

MAX_CLIENTS = 20  # browsers that may log in
# a text of 4000 letters as JSON; keys that step through the class send many requests
LIMITS = http_server.ServerLimits(body=65_536, client=Rate(200, 50))
PAGE = {
    "/": ("review.html", "text/html; charset=utf-8"),
    "/review.js": ("review.js", "text/javascript; charset=utf-8"),
    "/similarity.js": ("similarity.js", "text/javascript; charset=utf-8"),
    "/review.css": ("review.css", "text/css; charset=utf-8"),
    "/favicon.ico": ("mark.svg", "image/svg+xml"),
}


class Review:
    """A class, which only one request can read or change at a time."""

    def __init__(self, state):
        self._state, self._lock, self.changed_exercises = state, asyncio.Lock(), set()

    async def call(self, action, *arguments):
        """Call action(ClassState, *arguments) with the current state in a thread."""
        async with self._lock:
            return await asyncio.to_thread(self._refresh_and_call, action, arguments)

    def _refresh_and_call(self, action, arguments):
        self._state.refresh()
        return action(self._state, *arguments)


class ReviewHandler(http_server.ProtectedHandler):
    """Handler of requests about the class; it responds to errors with a message."""

    def initialize(self, review):
        self._review = review

    async def answer(self, action, *arguments):
        try:
            content = await self._review.call(action, *arguments)
        except manual_changes.ChangeRefused as error:
            self.set_status(409)
            content = {"error": str(error)}
        except GradebookError as error:
            self.set_status(503)
            content = {"error": str(error)}
        await self.respond(visible(content))


class Table(ReviewHandler):
    async def get(self):
        await self.answer(overview)


class Submission(ReviewHandler):
    """Handler that sends a submission, or sets its points, comment or answer."""

    async def get(self, row, exercise):
        await self.answer(lambda state: submission_view(state, _result(state, row, exercise)))

    async def post(self, row, exercise):
        content = self.json_body()
        seen, text = content.get("seen"), content.get("text")
        if isinstance(seen, bool) or not isinstance(seen, int) or not isinstance(text, str):
            raise HTTPError(400)

        def change(state):
            result = _result(state, row, exercise)
            match content:
                case {"task": str(task), "points": points}:
                    manual_changes.set_points(state, result, seen, task, points, text)
                case {"request": str(request)}:
                    manual_changes.answer(state, result, seen, request, text)
                case _:
                    manual_changes.comment(state, result, seen, text)
            self._review.changed_exercises.add(exercise)
            state.refresh()
            return submission_view(state, _result(state, row, exercise))

        await self.answer(change)


class Similarity(ReviewHandler):
    """Handler that sends the most similar pairs of an exercise, or one pair side by side."""

    async def get(self, exercise, *rows):
        def compared(state):
            try:
                view = pair_view if rows else pairs_view
                return view(state, exercise, *map(int, rows))
            except KeyError:
                raise HTTPError(404) from None

        await self.answer(compared)


def _result(state, row, exercise):
    results = state.exercise_results.get(exercise, [])
    if int(row) >= len(results):
        raise HTTPError(404)
    return results[int(row)]


def routes(review):
    arguments = {"review": review}
    return [
        *public_routes(static_files("classroom.reviewing", PAGE)),
        (r"/table", Table, arguments),
        (r"/submission/([0-9]{1,6})/([0-9]{2})", Submission, arguments),
        (r"/similarity/([0-9]{2})", Similarity, arguments),
        (r"/similarity/([0-9]{2})/([0-9]{1,6})/([0-9]{1,6})", Similarity, arguments),
    ]


async def serve(state, port=0, started=lambda address: None, ended=None):
    """Serve a class until a signal or ``ended``, and return the changed exercises; raise OSError if
    no port is free.

    started : function that is called with the address, which contains the token."""
    for name in ("tornado", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # requests are private
    review, ended = Review(state), ended or asyncio.Event()
    # browsers send a cookie to every port of an address, so its name identifies the server
    sessions = Sessions(f"slamlab-review-{secrets.token_hex(4)}", max_clients=MAX_CLIENTS)
    access_control = http_server.AccessControl(sessions, limits=LIMITS)
    server, port = http_server.listen(routes(review), access_control, port=port)
    stop_signals.stop_on_signals(ended.set)
    try:
        started(f"http://127.0.0.1:{port}/#{sessions.token}")
        await ended.wait()
    finally:
        server.stop()
        await review.call(lambda state: None)  # wait for a change that is being written
    return review.changed_exercises
