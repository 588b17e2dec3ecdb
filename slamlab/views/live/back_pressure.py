"""Back-pressure (backpressure, flow control): no frame is sent before the last one was drawn.

Of the scenes that come meanwhile only the newest is kept, so no queue of frames builds up.
"""

import asyncio
from contextlib import suppress
from time import monotonic


class Screen:
    """Display with back-pressure: at most one frame in flight, at most one pending, the newest.

    Subclasses implement ``_send_frame(scene)``. One that is told when a frame was drawn calls
    ``_acknowledge``; messages of the browser go to ``on_ready``, ``on_key`` and ``on_closed``.

    Parameters
    ----------
    acknowledged : bool; without, a frame counts as drawn after ``frame_period`` seconds
    frame_period : float, from one frame to the next at least [s], limits the frame rate

    ``keys`` says whether keys that are pressed on it reach ``on_key``, ``calm`` whether its reader
    asked for reduced motion (of the system, by ``prefers-reduced-motion``).
    """

    keys = calm = False

    def __init__(self, acknowledged, frame_period=0.1):
        self.on_ready = self.on_closed = lambda: None
        self.on_key = lambda name: None
        self.sent = self.drawn = 0  # numbers of the last frame sent and of the last one drawn
        self._acknowledged, self._frame_period = acknowledged, frame_period
        self._pending, self._drawn_event, self._last_sent = None, None, -frame_period

    @property
    def free(self):
        """bool, whether the last frame was acknowledged as drawn: the next one may be sent."""
        if not self._acknowledged:
            return monotonic() - self._last_sent >= self._frame_period
        return self.drawn >= self.sent

    def offer(self, scene):
        """Send a scene as a frame now, or make it the pending one until the last frame is drawn.

        Parameters
        ----------
        scene : Scene
        """
        # a screen that acknowledges nothing takes every frame: who steps by hand waits for none
        if self._acknowledged and not self.free:
            self._pending = scene
        else:
            self._show(scene)

    async def wait_until_drawn(self, timeout=0.25):
        """Wait until the last frame is acknowledged as drawn, or until a timeout [s]."""
        if not self._acknowledged:
            await asyncio.sleep(max(self._frame_period - (monotonic() - self._last_sent), 0))
            return
        event = asyncio.Event()
        self._drawn_event = asyncio.get_running_loop(), event
        if not self.free:
            # the browser may be gone: the caller sees whether to go on
            with suppress(TimeoutError):
                await asyncio.wait_for(event.wait(), timeout)

    def _show(self, scene):
        self._pending = None
        self.sent, self._last_sent = self.sent + 1, monotonic()
        self._send_frame(scene)

    def _send_frame(self, scene):
        raise NotImplementedError

    def _client_ready(self):
        """A browser has opened the view, perhaps anew: no frame is in flight."""
        self.drawn, self._pending = self.sent, None
        self.on_ready()

    def _acknowledge(self, number):
        if number > self.sent:
            return  # of a kernel before this one
        self.drawn = max(self.drawn, number)
        if self.free and self._pending is not None:
            self._show(self._pending)
        elif self.free and self._drawn_event is not None:
            loop, event = self._drawn_event
            if not loop.is_closed():
                # messages may come in by another thread than the one that waits
                loop.call_soon_threadsafe(event.set)
