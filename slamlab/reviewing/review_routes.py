"""Serve a class's marks to a page of this machine: routes, start and end."""

import asyncio
import logging
import secrets

from tornado.web import HTTPError

from slamlab.grading.database import GradebookError
from slamlab.listening import guard
from slamlab.listening.door import Door
from slamlab.listening.ending import end_on_signals
from slamlab.listening.entrance import open_routes, shipped
from slamlab.listening.rates import Rate
from slamlab.reviewing import hand_changes
from slamlab.reviewing.class_overview import overview
from slamlab.reviewing.likeness_view import pair_view, pairs_view
from slamlab.reviewing.submission_view import submission_view
from slamlab.reviewing.visible_text import visible

PAGES = 20  # how many browsers may be let in
# a text of 4000 letters as JSON; whoever leafs through the class by its keys asks often
BOUNDS = guard.Bounds(body=65_536, client=Rate(200, 50))
SHIPPED = {
    "/": ("review.html", "text/html; charset=utf-8"),
    "/review.js": ("review.js", "text/javascript; charset=utf-8"),
    "/likeness.js": ("likeness.js", "text/javascript; charset=utf-8"),
    "/review.css": ("review.css", "text/css; charset=utf-8"),
    "/favicon.ico": ("mark.svg", "image/svg+xml"),
}


class Review:
    """A class that is looked at; one request at a time reads or changes it.

    Parameters
    ----------
    state : ClassState
    """

    def __init__(self, state):
        self._state, self._turn, self.touched = state, asyncio.Lock(), set()

    async def do(self, deed, *given):
        """Do something with the newest state, beside the loop that listens.

        Parameters
        ----------
        deed : callable (ClassState, *given)

        Returns
        -------
        what it gives
        """
        async with self._turn:
            return await asyncio.to_thread(self._done, deed, given)

    def _done(self, deed, given):
        self._state.refresh()
        return deed(self._state, *given)


class Asked(guard.Guarded):
    """A request about the class; what cannot be done is told in words."""

    def initialize(self, review):
        self._review = review

    async def tell(self, deed, *given):
        """Do something and answer what it gives."""
        try:
            told = await self._review.do(deed, *given)
        except hand_changes.Refused as error:
            self.set_status(409)
            told = {"error": str(error)}
        except GradebookError as error:
            self.set_status(503)
            told = {"error": str(error)}
        await self.give(visible(told))


class Table(Asked):
    async def get(self):
        await self.tell(overview)


class Submission(Asked):
    """A submission, and points, a comment or an answer for it."""

    async def get(self, row, exercise):
        await self.tell(lambda state: submission_view(state, _standing(state, row, exercise)))

    async def post(self, row, exercise):
        said = self.body()
        seen, text = said.get("seen"), said.get("text")
        if isinstance(seen, bool) or not isinstance(seen, int) or not isinstance(text, str):
            raise HTTPError(400)

        def change(state):
            standing = _standing(state, row, exercise)
            match said:
                case {"task": str(task), "points": points}:
                    hand_changes.set_points(state, standing, seen, task, points, text)
                case {"request": str(request)}:
                    hand_changes.answer(state, standing, seen, request, text)
                case _:
                    hand_changes.comment(state, standing, seen, text)
            self._review.touched.add(exercise)
            state.refresh()
            return submission_view(state, _standing(state, row, exercise))

        await self.tell(change)


class Likeness(Asked):
    """The pairs of an exercise that are most alike, or two of them side by side."""

    async def get(self, exercise, *rows):
        def compared(state):
            try:
                view = pair_view if rows else pairs_view
                return view(state, exercise, *map(int, rows))
            except KeyError:
                raise HTTPError(404) from None

        await self.tell(compared)


def _standing(state, row, exercise):
    standings = state.standings.get(exercise, [])
    if int(row) >= len(standings):
        raise HTTPError(404)
    return standings[int(row)]


def routes(review):
    """The whole table of routes.

    Parameters
    ----------
    review : Review

    Returns
    -------
    list of tornado's routes
    """
    known = {"review": review}
    return [
        *open_routes(shipped("slamlab.reviewing", SHIPPED)),
        (r"/table", Table, known),
        (r"/submission/([0-9]{1,6})/([0-9]{2})", Submission, known),
        (r"/likeness/([0-9]{2})", Likeness, known),
        (r"/likeness/([0-9]{2})/([0-9]{1,6})/([0-9]{1,6})", Likeness, known),
    ]


async def serve(state, port=0, begun=lambda address: None, over=None):
    """Serve a class on this machine until a signal ends it.

    Parameters
    ----------
    state : ClassState
    port : int, any free one by default
    begun : callable(str), told the address with its token as soon as a page can open it
    over : asyncio.Event or None, which ends it, too

    Returns
    -------
    set of str, the exercises in which something was changed

    Raises
    ------
    OSError : the port is taken
    """
    for name in ("tornado", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # who asked for what is not told
    review, over = Review(state), over or asyncio.Event()
    # a cookie is sent to every port of an address: its name says whose it is
    door = Door(f"slamlab-review-{secrets.token_hex(4)}", admits=PAGES)
    server, port = guard.listen(routes(review), guard.Guard(door, bounds=BOUNDS), port=port)
    end_on_signals(over.set)
    try:
        begun(f"http://127.0.0.1:{port}/#{door.token}")
        await over.wait()
    finally:
        server.stop()
        await review.do(lambda state: None)  # what is being written is written
    return review.touched
