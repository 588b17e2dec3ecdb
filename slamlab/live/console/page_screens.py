"""Screens of the console's pages, which show the same run; no page delays another."""

import asyncio
import json
import struct
from time import monotonic

from slamlab.live.back_pressure import Screen
from slamlab.live.frame_packing import FramePacker, pack_frame

DRAW_TIMEOUT = 0.25  # without an acknowledgement the page is hidden, and nothing waits for it [s]
MAX_PAGES = 16  # at a time


class PageScreen(Screen):
    """Screen of one page, which receives frames by ``send(bytes)``. A message consists of the
    header's length (32 bits, little endian), the header as JSON, and float32 rows.
    """

    def __init__(self, send):
        super().__init__(acknowledged=True)
        self._send, self._packer, self.ready = send, FramePacker(), False

    @property
    def drawing(self):
        """Whether a visible page is still drawing a frame."""
        return not self.free and monotonic() - self._last_sent < DRAW_TIMEOUT

    def start(self, scene):
        self._packer.reset()
        self.ready = True
        self._client_ready()
        self.offer(scene)

    def acknowledge(self, number):
        self._acknowledge(number)

    def _send_frame(self, scene):
        header, rows = pack_frame(scene, self._packer, self.sent, self.drawn)
        packed = json.dumps(header).encode()
        self._send(struct.pack("<I", len(packed)) + packed + rows)


class PageScreens:
    """Screens of all pages, combined as the screen of a run loop."""

    keys = calm = False

    def __init__(self):
        self.on_ready = self.on_closed = lambda: None
        self.on_key = lambda name: None
        self._pages, self._scene = [], None

    def __len__(self):
        return len(self._pages)

    def add(self, page):
        """Add a page; return False if there are too many."""
        if len(self._pages) >= MAX_PAGES:
            return False
        self._pages.append(page)
        return True

    def remove(self, page):
        if page in self._pages:
            self._pages.remove(page)

    def start(self, page, calm):
        """Show the current scene on a page; ``calm``: whether its reader prefers reduced motion."""
        self.calm = calm
        if self._scene is not None:
            page.start(self._scene)
        self.on_ready()

    def offer(self, scene):
        self._scene = scene
        for page in self._pages:
            if page.ready:
                page.offer(scene)
            else:
                page.start(scene)

    @property
    def free(self):
        """Whether every visible page has drawn its last frame."""
        return not any(page.drawing for page in self._pages)

    async def wait_until_drawn(self):
        late = [page.wait_until_drawn(DRAW_TIMEOUT) for page in self._pages if page.drawing]
        await asyncio.gather(*late)
