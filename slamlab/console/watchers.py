"""Watchers: pages that show one run, each at its own pace; none of them holds up another."""

import asyncio
import json
import struct
from time import monotonic

from slamlab.views.live.back_pressure import Screen
from slamlab.views.live.frame_packing import FramePacker, pack_frame

ASLEEP = 0.25  # without an answer: the page is out of sight, and nobody waits for it [s]
MOST = 16  # pages at a time


class PageScreen(Screen):
    """Screen of one page: frames go over its socket, each drawn one is acknowledged.

    A message is the length of the header (32 bits, little endian), the header as JSON, float32 rows
    (:mod:`slamlab.views.live.frame_packing`).

    Parameters
    ----------
    send : callable(bytes)
    """

    def __init__(self, send):
        super().__init__(acknowledged=True)
        self._send, self._packer, self.ready = send, FramePacker(), False

    @property
    def waited_for(self):
        """bool, whether the next frame had better wait: one is on its way to a page in sight."""
        return not self.free and monotonic() - self._last_sent < ASLEEP

    def begin(self, scene):
        """The page is there: it gets a whole frame."""
        self._packer.reset()
        self.ready = True
        self._client_ready()
        self.offer(scene)

    def acknowledge(self, number):
        """The page has drawn a frame."""
        self._acknowledge(number)

    def _send_frame(self, scene):
        header, rows = pack_frame(scene, self._packer, self.sent, self.drawn)
        told = json.dumps(header).encode()
        self._send(struct.pack("<I", len(told)) + told + rows)


class Watchers:
    """All pages that look, as the one screen of a run loop."""

    keys = calm = False

    def __init__(self):
        self.on_ready = self.on_closed = lambda: None
        self.on_key = lambda name: None
        self._pages, self._scene = [], None

    def __len__(self):
        """Number of pages."""
        return len(self._pages)

    def join(self, page):
        """Let a page look.

        Parameters
        ----------
        page : PageScreen

        Returns
        -------
        bool, False where there are too many
        """
        if len(self._pages) >= MOST:
            return False
        self._pages.append(page)
        return True

    def leave(self, page):
        """A page looks no more."""
        if page in self._pages:
            self._pages.remove(page)

    def begin(self, page, calm):
        """A page has opened and shows the present scene; the loop may begin to run.

        Parameters
        ----------
        page : PageScreen
        calm : bool, whether its reader asked for reduced motion
        """
        self.calm = calm
        if self._scene is not None:
            page.begin(self._scene)
        self.on_ready()

    def offer(self, scene):
        """Offer a scene to every page: see :meth:`Screen.offer`."""
        self._scene = scene
        for page in self._pages:
            if page.ready:
                page.offer(scene)
            else:
                page.begin(scene)

    @property
    def free(self):
        """bool, whether every page in sight has drawn its last frame."""
        return not any(page.waited_for for page in self._pages)

    async def wait_until_drawn(self):
        """Wait for the pages in sight, a moment at most."""
        late = [page.wait_until_drawn(ASLEEP) for page in self._pages if page.waited_for]
        await asyncio.gather(*late)
