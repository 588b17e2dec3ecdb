"""Audience server: two HTTP servers, for the phones and for the lecturer's page."""

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

from classroom.audience import addresses, lecturer_routes, phone_routes
from classroom.audience.lecture_state import LectureState
from slamlab.live.web_server import http_server
from slamlab.live.web_server.rate_limits import Rate
from slamlab.live.web_server.sessions import BearerToken, Sessions

# The lecturer's page is one client, and sends whole slides.
LECTURER_LIMITS = http_server.ServerLimits(
    body=12_000_000,
    address=Rate(100, 10),
    all_addresses=Rate(100, 10),
    client=Rate(200, 50),
    all_clients=Rate(200, 50),
)
COOKIE = "slamlab-class"
END_DELAY = 5.0  # [s], for phones to receive the end of the lecture


def _serve_phones(lecture, host, port):
    for tried in (port, 0):  # the usual port may be taken
        try:
            # browsers send a cookie to every port of an address, so its name identifies the server
            sessions = Sessions(COOKIE)
            access_control = http_server.AccessControl(sessions)
            routes = phone_routes.routes(lecture)
            server, port = http_server.listen(routes, access_control, host, tried)
            return server, port, sessions, access_control.publish("class")
        except OSError as error:
            failed = error
    raise SystemExit(
        f"cannot listen on {host}: {failed.strerror}. Check that it is an address of this machine."
    )


def _connection(origin, host, ports, places, control, sessions, bearer):
    """Return a dict that describes how pages connect to the servers."""
    return {
        "pid": os.getpid(),
        "origin": origin,
        "host": host,
        "ports": ports,
        "code": sessions.code,
        "addresses": [
            {"address": place, "qr": addresses.qr_code(f"{place}/#{sessions.token}")}
            for place in places
        ],
        "control": control,
        "key": bearer.token,
    }


def _write_state(path, connection):
    """Write a file atomically, readable only by its owner."""
    draft = path.with_suffix(f".{os.getpid()}")
    with contextlib.suppress(FileNotFoundError):
        draft.unlink()
    with open(os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
        json.dump(connection, file)
    draft.replace(path)


def _remove_state(path):
    """Remove the file unless another process has written it."""
    with contextlib.suppress(OSError, ValueError):
        if json.loads(path.read_text())["pid"] == os.getpid():
            path.unlink()


async def serve(origin, host, port, state=None, patience=600.0, clock=time.monotonic):
    """Serve until the lecture ends or the lecturer's page sends no request for ``patience`` [s].

    port : port for the phones; if it is in use, another port is chosen. state : file for the
    addresses, where a new kernel finds them. Raises SystemExit if no port can be opened."""
    lecture = LectureState(clock, patience)
    stop = asyncio.Event()
    for name in ("SIGINT", "SIGTERM"):
        with contextlib.suppress(NotImplementedError):  # Windows
            asyncio.get_running_loop().add_signal_handler(getattr(signal, name), stop.set)
    bearer = BearerToken()
    server, port, sessions, public = _serve_phones(lecture, host, port)
    access_control = http_server.AccessControl(bearer, origin, LECTURER_LIMITS)
    routes = lecturer_routes.routes(lecture, sessions)
    lecturer_server, lecturer_port = http_server.listen(routes, access_control)
    control = access_control.publish(f"proxy/{lecturer_port}")
    control = control or f"http://127.0.0.1:{lecturer_port}"
    places = [public] if public else [f"http://{a}:{port}" for a in addresses.reachable(host)]
    ports = {"phones": port, "lecturer": lecturer_port}
    connection = _connection(origin, host, ports, places, control, sessions, bearer)
    if state is not None:
        _write_state(state, connection)
    print(json.dumps(connection), flush=True)
    try:
        while not (lecture.over or lecture.abandoned or stop.is_set()):
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(stop.wait(), 0.2)
    finally:
        if state is not None:
            _remove_state(state)
    lecturer_server.stop()
    if not lecture.over:
        lecture.end()
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(stop.wait(), END_DELAY)
    server.stop()


def run(arguments):
    """Run the servers in an empty folder and print only their addresses."""
    for name in ("tornado", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # requests are private
    state = Path(arguments.state).resolve() if arguments.state else None
    with tempfile.TemporaryDirectory(prefix="slamlab-audience-") as empty:
        before = os.getcwd()
        os.chdir(empty)
        try:
            asyncio.run(
                serve(arguments.origin, arguments.host, arguments.port, state, arguments.patience)
            )
        finally:
            os.chdir(before)  # Windows cannot remove the working directory of a process
    sys.stdout.flush()
