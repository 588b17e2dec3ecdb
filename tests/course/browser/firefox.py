"""Headless Firefox, controlled by WebDriver BiDi.

Playwright drives only a Firefox that was built for it.
"""

import asyncio
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import count

from tornado.websocket import websocket_connect

from tests.timeouts import PATIENCE

PROGRAMS = ("firefox", "firefox-esr")
LEFT = "NetworkError when attempting to fetch resource"
LISTENING = re.compile(r"BiDi listening on (ws://\S+)")


class Missing(Exception):
    """There is no Firefox here."""


@contextmanager
def firefox():
    """Open Firefox.

    Yields
    ------
    Tab, its only one

    Raises
    ------
    Missing
    """
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        raise Missing("no Firefox here")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        words = ["--headless", "--no-remote", "--profile", profile, "--remote-debugging-port", "0"]
        running = subprocess.Popen(
            [program, *words],
            env=os.environ | {"HOME": profile},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        try:
            address = next(filter(None, map(LISTENING.search, running.stderr)), None)
            if address is None:
                raise Missing(f"{program} listens to nobody")
            # Playwright's event loop runs in this thread: another neither runs nor ends here
            with ThreadPoolExecutor(1) as thread:
                runner = asyncio.Runner()
                try:
                    yield Tab(lambda asked: thread.submit(runner.run, asked).result(), address[1])
                finally:
                    thread.submit(runner.close).result()
        finally:
            os.killpg(running.pid, signal.SIGKILL)  # its content has processes of its own
            running.communicate()


class Tab:
    """A tab; ``wrong`` are the errors of its console.

    Parameters
    ----------
    run : callable(coroutine)
    address : str, of BiDi
    """

    def __init__(self, run, address):
        self._run, self._numbers, self.wrong = run, count(1), []
        self._socket = run(_connected(f"{address}/session"))
        self._say("session.new", capabilities={})
        self._say("session.subscribe", events=["log.entryAdded"])
        self._tab = self._say("browsingContext.getTree")["contexts"][0]["context"]

    def open(self, address):
        """Open an address and wait until all of it is there."""
        before = len(self.wrong)
        self._say("browsingContext.navigate", context=self._tab, url=address, wait="complete")
        # what the page before was still fetching is given up
        self.wrong[before:] = [error for error in self.wrong[before:] if LEFT not in error]

    def evaluate(self, script):
        """The value of an expression, str, bool or number; of a promise what it promises."""
        made = self._say(
            "script.evaluate",
            expression=script,
            target={"context": self._tab},
            awaitPromise=True,
        )
        assert made["type"] == "success", made
        return made["result"].get("value")

    def _say(self, method, **params):
        return self._run(asyncio.wait_for(self._command(method, params), PATIENCE))

    async def _command(self, method, params):
        number = next(self._numbers)
        reported = {"id": number, "method": method, "params": params}
        await self._socket.write_message(json.dumps(reported))
        while True:
            answer = await self._socket.read_message()
            assert answer is not None, "Firefox has gone"
            answer = json.loads(answer)
            if answer.get("method") == "log.entryAdded" and answer["params"]["level"] == "error":
                self.wrong.append(answer["params"]["text"])
            if answer.get("id") == number:
                assert answer["type"] == "success", answer
                return answer["result"]


async def _connected(address):
    return await websocket_connect(address)
