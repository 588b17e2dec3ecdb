"""What a picture that moves must offer: a screen shows one scene at a time, the newest."""

import asyncio
from contextlib import suppress
from time import monotonic


class Screen:
    """Shows scenes; at most one is on its way, at most one waits, and that is the newest.

    Subclasses implement ``_put(scene)``. One that is told when a picture was drawn calls
    ``_acknowledge``; messages of the browser go to ``on_ready``, ``on_key`` and ``on_closed``.

    Parameters
    ----------
    acknowledged : bool; without, a picture counts as drawn after ``gap`` seconds
    gap : float [s]

    ``keys`` says whether keys that are pressed on it reach ``on_key``.
    """

    keys = False

    def __init__(self, acknowledged, gap=0.1):
        self.on_ready = self.on_closed = lambda: None
        self.on_key = lambda name: None
        self.sent = self.drawn = 0  # numbers of the last frame sent and of the last one drawn
        self._acknowledged, self._gap = acknowledged, gap
        self._waiting, self._told, self._last = None, None, -gap

    @property
    def free(self):
        """bool, whether the last picture was drawn."""
        if not self._acknowledged:
            return monotonic() - self._last >= self._gap
        return self.drawn >= self.sent

    def offer(self, scene):
        """Show a scene, now or, instead of any that waits, when the picture before is drawn.

        Parameters
        ----------
        scene : Scene
        """
        # a screen that acknowledges nothing takes every picture: who steps by hand waits for none
        if self._acknowledged and not self.free:
            self._waiting = scene
        else:
            self._show(scene)

    async def until_drawn(self, patience=0.25):
        """Wait until the last picture is drawn, or for so long [s]."""
        if not self._acknowledged:
            await asyncio.sleep(max(self._gap - (monotonic() - self._last), 0))
            return
        told = asyncio.Event()
        self._told = asyncio.get_running_loop(), told
        if not self.free:
            # the browser may be gone: the caller sees whether to go on
            with suppress(TimeoutError):
                await asyncio.wait_for(told.wait(), patience)

    def _show(self, scene):
        self._waiting = None
        self.sent, self._last = self.sent + 1, monotonic()
        self._put(scene)

    def _put(self, scene):
        raise NotImplementedError

    def _begun(self):
        """A browser has opened the picture, perhaps anew: nothing is on its way."""
        self.drawn, self._waiting = self.sent, None
        self.on_ready()

    def _acknowledge(self, number):
        if number > self.sent:
            return  # of a kernel before this one
        self.drawn = max(self.drawn, number)
        if self.free and self._waiting is not None:
            self._show(self._waiting)
        elif self.free and self._told is not None:
            loop, told = self._told
            if not loop.is_closed():
                # messages may come in by another thread than the one that waits
                loop.call_soon_threadsafe(told.set)
