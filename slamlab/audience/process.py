"""The life of the class's process: it listens, says where, and ends after the lecturer's page."""

import asyncio
import contextlib
import json
import logging
import os
import signal
import sys
import tempfile
import time
from pathlib import Path

from slamlab.audience import addresses, control, phones
from slamlab.audience.lecture import Lecture
from slamlab.listening import guard
from slamlab.listening.door import Door, Key
from slamlab.listening.rates import Rate

# The lecturer's page sends whole slides, and it is one client.
FOR_CONTROL = guard.Bounds(
    body=12_000_000,
    stranger=Rate(100, 10),
    strangers=Rate(100, 10),
    client=Rate(200, 50),
    clients=Rate(200, 50),
)
FAREWELL = 5.0  # [s], for phones to hear that it is over


def _listen_for_phones(lecture, host, port):
    for tried in (port, 0):  # the usual port may be taken
        try:
            # a cookie is sent to every port of an address: its name says whose it is
            door = Door("slamlab-class")
            server, port = guard.listen(phones.routes(lecture), guard.Guard(door), host, tried)
            return server, port, door
        except OSError as error:
            failed = error
    raise SystemExit(f"cannot listen on {host}: {failed.strerror}; is it this machine's address?")


def _told(origin, host, port, door, control_port, key):
    """What the lecturer's page must know."""
    places = [f"{address}:{port}" for address in addresses.reachable(host)]
    return {
        "pid": os.getpid(),
        "origin": origin,
        "host": host,
        "code": door.code,
        "addresses": [
            {"address": place, "qr": addresses.qr_code(f"http://{place}/#{door.token}")}
            for place in places
        ],
        "control": f"http://127.0.0.1:{control_port}",
        "key": key.token,
    }


def _keep(path, told):
    """Write a file that only its owner can read, whole or not at all."""
    draft = path.with_suffix(f".{os.getpid()}")
    with contextlib.suppress(FileNotFoundError):
        draft.unlink()
    with open(os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
        json.dump(told, file)
    draft.replace(path)


def _drop(path):
    """Remove the file unless another process has written it since."""
    with contextlib.suppress(OSError, ValueError):
        if json.loads(path.read_text())["pid"] == os.getpid():
            path.unlink()


async def listen(origin, host, port, state=None, patience=600.0, clock=time.monotonic):
    """Listen until the lecture is over, or the lecturer's page has been silent for too long.

    Parameters
    ----------
    origin : str, of the lecturer's page
    host : str, on which phones are listened for
    port : int, for phones; any other one if it is taken
    state : Path or None, where to keep the addresses, so that a new kernel finds them
    patience : float [s], how long the lecturer's page may be silent
    clock : callable -> float [s]

    Raises
    ------
    SystemExit : it cannot listen there
    """
    lecture = Lecture(clock, patience)
    stop = asyncio.Event()
    for name in ("SIGINT", "SIGTERM"):
        with contextlib.suppress(NotImplementedError):  # Windows
            asyncio.get_running_loop().add_signal_handler(getattr(signal, name), stop.set)
    key = Key()
    server, port, door = _listen_for_phones(lecture, host, port)
    own = guard.Guard(key, origin, FOR_CONTROL)
    control_server, control_port = guard.listen(control.routes(lecture, door), own)
    told = _told(origin, host, port, door, control_port, key)
    if state is not None:
        _keep(state, told)
    print(json.dumps(told), flush=True)
    try:
        while not (lecture.over or lecture.abandoned or stop.is_set()):
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(stop.wait(), 0.2)
    finally:
        if state is not None:
            _drop(state)
    control_server.stop()
    if not lecture.over:
        lecture.end()
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(stop.wait(), FAREWELL)
    server.stop()


def run(arguments):
    """Run the process with its own empty folder, and with nothing to say but its addresses.

    Parameters
    ----------
    arguments : Namespace with origin, host, port, state, patience
    """
    logging.getLogger("tornado").setLevel(logging.CRITICAL + 1)  # who asked for what is not told
    logging.getLogger("asyncio").setLevel(logging.CRITICAL + 1)
    state = Path(arguments.state).resolve() if arguments.state else None
    with tempfile.TemporaryDirectory(prefix="slamlab-audience-") as empty:
        before = os.getcwd()
        os.chdir(empty)
        try:
            asyncio.run(
                listen(arguments.origin, arguments.host, arguments.port, state, arguments.patience)
            )
        finally:
            os.chdir(before)  # Windows removes no folder in which somebody stands
    sys.stdout.flush()
