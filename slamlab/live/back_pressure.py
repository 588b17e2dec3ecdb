"""Back-pressure (flow control) of the live view: a frame waits until the previous one is drawn."""

import asyncio
from contextlib import suppress
from time import monotonic


class Screen:
    """Display with at most one frame in flight and one pending frame, which is the newest.
    Subclasses implement ``_send_frame(scene)`` and call ``_acknowledge(number)`` when the frame is
    drawn. Without ``acknowledged``, a frame counts as drawn after ``frame_period`` [s]. ``keys``:
    whether pressed keys reach ``on_key``. ``calm``: whether the reader prefers reduced motion.
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
        if not self._acknowledged:
            return monotonic() - self._last_sent >= self._frame_period
        return self.drawn >= self.sent

    def offer(self, scene):
        """Send a scene now, or as soon as the previous frame is drawn."""
        # a screen without acknowledgements takes every frame, so that steps by hand do not wait
        if self._acknowledged and not self.free:
            self._pending = scene
        else:
            self._show(scene)

    async def wait_until_drawn(self, timeout=0.25):
        """Wait until the last frame is drawn, or until a timeout [s]."""
        if not self._acknowledged:
            await asyncio.sleep(max(self._frame_period - (monotonic() - self._last_sent), 0))
            return
        event = asyncio.Event()
        self._drawn_event = asyncio.get_running_loop(), event
        if not self.free:
            # the browser may be closed: the caller decides whether to continue
            with suppress(TimeoutError):
                await asyncio.wait_for(event.wait(), timeout)

    def _show(self, scene):
        self._pending = None
        self.sent, self._last_sent = self.sent + 1, monotonic()
        self._send_frame(scene)

    def _send_frame(self, scene):
        raise NotImplementedError

    def _client_ready(self):
        """Handle a browser that opens or reloads the view: from now on, no frame is in flight."""
        self.drawn, self._pending = self.sent, None
        self.on_ready()

    def _acknowledge(self, number):
        if number > self.sent:
            return  # of an earlier kernel
        self.drawn = max(self.drawn, number)
        if self.free and self._pending is not None:
            self._show(self._pending)
        elif self.free and self._drawn_event is not None:
            loop, event = self._drawn_event
            if not loop.is_closed():
                # messages may arrive in another thread than the one that waits
                loop.call_soon_threadsafe(event.set)
