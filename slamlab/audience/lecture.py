"""What is known while a lecture lasts, in memory alone: the slides shown, the poll, its end."""

import asyncio
import contextlib
from dataclasses import dataclass

from slamlab.audience.poll import Poll
from slamlab.audience.sanitising import clean

MOST_SLIDES, MOST_BYTES = 300, 64_000_000


@dataclass(frozen=True)
class Slide:
    """A slide as it stood when it was last shown.

    Parameters
    ----------
    place : int, its number on the lecturer's screen
    html : str, sanitised
    pictures : dict, name to (media type, bytes)
    version : int, of the lecture when it changed
    """

    place: int
    html: str
    pictures: dict
    version: int


class Lecture:
    """Slides shown so far, the poll, and who waits for a change.

    Parameters
    ----------
    clock : callable -> float [s]
    patience : float [s], how long the lecturer's page may be silent
    """

    def __init__(self, clock, patience=600.0):
        self._clock, self._patience, self._heard = clock, patience, clock()
        self.version, self.over = 0, False
        self.slides, self.shown, self.poll = {}, None, None
        self._polls, self._changed = 0, asyncio.Event()

    def hear(self):
        """The lecturer's page is there."""
        self._heard = self._clock()

    @property
    def abandoned(self):
        """bool, whether the lecturer's page has been silent for too long."""
        return self._clock() - self._heard > self._patience

    def show(self, number, place, html):
        """Show a slide; that it looks as before is no change.

        Parameters
        ----------
        number : int, of its first cell: a long slide has pages
        place : int, its number on the lecturer's screen
        html : str, as it comes

        Raises
        ------
        ValueError : too many slides, or too large ones
        """
        kept, pictures = clean(html)
        before = self.slides.get(number)
        if self.shown == number and before is not None and before.html == kept:
            return
        others = [slide for other, slide in self.slides.items() if other != number]
        size = sum(map(_size, others)) + len(kept) + sum(len(b) for _, b in pictures.values())
        if len(others) >= MOST_SLIDES or size > MOST_BYTES:
            raise ValueError("these slides are too many or too large for the phones")
        self._change()
        same = before is not None and before.html == kept
        self.slides[number] = before if same else Slide(place, kept, pictures, self.version)
        self.shown = number

    def picture(self, name):
        """A picture of a slide shown: (media type, bytes), or None."""
        for slide in self.slides.values():
            if name in slide.pictures:
                return slide.pictures[name]
        return None

    def ask(self, question, text, choices, unit):
        """Open a poll, in the place of one before.

        Parameters
        ----------
        question : str, the notebook's name of it
        text : str, HTML as it comes
        choices : list of str, HTML as it comes, or None for a number
        unit : str, plain text

        Raises
        ------
        ValueError : it cannot be asked so
        """
        words = None if choices is None else [clean(choice)[0] for choice in choices]
        self.poll = Poll(self._polls + 1, question, clean(text)[0], words, unit)
        self._polls += 1
        self._change()

    def close_poll(self):
        """Close the poll, so that the class sees what came out."""
        self.poll.is_open = False
        self._change()

    def raise_hands(self, hands):
        """Take a show of hands (see Poll); a class that sees the counts sees these, too."""
        self.poll.raise_hands(hands)
        if not self.poll.is_open:
            self._change()

    def drop_poll(self):
        """Take the poll away; its votes are forgotten."""
        self.poll = None
        self._change()

    def end(self):
        """Tell the class that the lecture is over, and forget everything else."""
        self.over, self.poll, self.shown = True, None, None
        self.slides.clear()
        self._change()

    def state(self, client):
        """What a phone is told.

        Parameters
        ----------
        client : str

        Returns
        -------
        dict
        """
        told = {"version": self.version, "over": self.over, "shown": self.shown}
        told["slides"] = {number: slide.version for number, slide in sorted(self.slides.items())}
        poll = self.poll
        told["poll"] = poll and {
            "number": poll.number,
            "text": poll.text,
            "choices": poll.choices,
            "unit": poll.unit,
            "open": poll.is_open,
            "mine": poll.vote_of(client),
            "result": None if poll.is_open else poll.counts(),
        }
        return told

    async def newer_than(self, version, seconds):
        """Wait until something has changed, but not for ever.

        Parameters
        ----------
        version : int, what is known already
        seconds : float
        """
        if version == self.version:
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._changed.wait(), seconds)

    def _change(self):
        self.version += 1
        self._changed.set()
        self._changed = asyncio.Event()


def _size(slide):
    return len(slide.html) + sum(len(content) for _, content in slide.pictures.values())
