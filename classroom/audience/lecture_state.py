"""State of a running lecture, only in memory: slides, poll, and waiting clients."""

import asyncio
import contextlib
from dataclasses import dataclass

from classroom.audience.poll import Poll
from classroom.audience.sanitising import clean

MAX_SLIDES, MAX_BYTES = 300, 64_000_000


@dataclass(frozen=True)
class Slide:
    """A slide in the version that was last shown."""

    place: int  # its number on the lecturer's screen
    html: str  # sanitised
    pictures: dict  # name to (media type, bytes)
    version: int  # of the state when the slide changed


class LectureState:
    """Slides shown so far, the poll, and clients that wait for a change.

    patience : timeout without a request from the lecturer's page [s]."""

    def __init__(self, clock, patience=600.0):
        self._clock, self._patience, self._last_request = clock, patience, clock()
        self.version, self.over = 0, False
        self.slides, self.shown, self.poll = {}, None, None
        self._polls, self._changed = 0, asyncio.Event()

    def keep_alive(self):
        """Record that the lecturer's page sent a request."""
        self._last_request = self._clock()

    @property
    def abandoned(self):
        """Whether the lecturer's page has sent no request for too long."""
        return self._clock() - self._last_request > self._patience

    def show(self, number, place, html):
        """Show a slide if it changed; raise ValueError if slides are too many or too large.

        number : number of the slide's first cell (a long slide has pages). place : the displayed
        number."""
        kept, pictures = clean(html)
        before = self.slides.get(number)
        if self.shown == number and before is not None and before.html == kept:
            return
        others = [slide for other, slide in self.slides.items() if other != number]
        size = sum(map(_size, others)) + len(kept) + sum(len(b) for _, b in pictures.values())
        if len(others) >= MAX_SLIDES or size > MAX_BYTES:
            raise ValueError("the lecture has too many slides, or the slides are too large")
        self._change()
        same = before is not None and before.html == kept
        self.slides[number] = before if same else Slide(place, kept, pictures, self.version)
        self.shown = number

    def picture(self, name):
        """Return a picture of a shown slide as (media type, bytes), or None."""
        for slide in self.slides.values():
            if name in slide.pictures:
                return slide.pictures[name]
        return None

    def ask(self, question, text, choices, unit):
        """Replace any earlier poll with a new Poll from unsanitised HTML; raise ValueError if it is
        invalid."""
        labels = None if choices is None else [clean(choice)[0] for choice in choices]
        self.poll = Poll(self._polls + 1, question, clean(text)[0], labels, unit)
        self._polls += 1
        self._change()

    def close_poll(self):
        self.poll.is_open = False
        self._change()

    def raise_hands(self, hands):
        """Set the counts of raised hands; phones that display the counts of votes update them."""
        self.poll.raise_hands(hands)
        if not self.poll.is_open:
            self._change()

    def drop_poll(self):
        self.poll = None
        self._change()

    def end(self):
        """End the lecture and delete its slides and poll."""
        self.over, self.poll, self.shown = True, None, None
        self.slides.clear()
        self._change()

    def state(self, client):
        state = {"version": self.version, "over": self.over, "shown": self.shown}
        state["slides"] = {number: slide.version for number, slide in sorted(self.slides.items())}
        poll = self.poll
        state["poll"] = poll and {
            "number": poll.number,
            "text": poll.text,
            "choices": poll.choices,
            "unit": poll.unit,
            "open": poll.is_open,
            "mine": poll.vote_of(client),
            "result": None if poll.is_open else poll.counts(),
        }
        return state

    async def newer_than(self, version, timeout):
        """Wait for a newer version, but not longer than a timeout [s]."""
        if version == self.version:
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._changed.wait(), timeout)

    def _change(self):
        self.version += 1
        self._changed.set()
        self._changed = asyncio.Event()


def _size(slide):
    return len(slide.html) + sum(len(content) for _, content in slide.pictures.values())
