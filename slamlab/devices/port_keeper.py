"""Process that owns a port for a program that may die: ``python -m slamlab.devices.port_keeper``.

It passes bytes on, both ways. When its program ends, however (killed, too), or says nothing for too
long, it writes a farewell to the device: a robot then stands.

Frames on both pipes: kind, length of the payload (16 bits, little endian), payload. To it: WRITE,
DTR; from it: OPENED or FAILED first, then READ, and FAILED when the connection is lost.
"""

import contextlib
import json
import os
import signal
import struct
import sys
import threading
import time

from slamlab.devices.errors import ConnectionLost, PortError
from slamlab.devices.transport import open_port

WRITE, DTR, OPENED, FAILED, READ = b"w", b"d", b"o", b"f", b"r"  # kinds of frames
MAX_PAYLOAD = 0xFFFF
READ_TIMEOUT = 0.05  # of one read of the port [s]; so often silence is looked for
SENDING = 0.1  # [s] for the farewell to leave, before the port is closed
_HEAD = struct.Struct("<cH")


def frame(kind, payload=b""):
    """A frame of a pipe, bytes."""
    return _HEAD.pack(kind, len(payload)) + payload


def frames(pipe):
    """Yield each frame (kind, payload) of a pipe until it ends.

    Parameters
    ----------
    pipe : binary file
    """
    while len(head := pipe.read(_HEAD.size)) == _HEAD.size:
        kind, size = _HEAD.unpack(head)
        payload = pipe.read(size)
        if len(payload) < size:
            return
        yield kind, payload


class Keeper:
    """Owner of an open port; two threads: one reads the port, one its program.

    Parameters
    ----------
    port : Transport
    farewell : bytes, what leaves the device at rest
    silence : float, for how long its program may write nothing [s], or None
    tell : callable(bytes), puts a frame on the way to the program
    clock : callable -> float [s]
    """

    def __init__(self, port, farewell, silence, tell, clock=time.monotonic):
        self._port, self._farewell, self._silence = port, farewell, silence
        self._tell, self._clock, self._lock = tell, clock, threading.Lock()
        self._heard, self._at_rest, self.ended = clock(), True, False

    def take(self, kind, payload):
        """Take in a frame of the program."""
        if kind == WRITE:
            with self._lock:
                self._heard, self._at_rest = self._clock(), False
                self._port.write(payload)
        elif kind == DTR:
            self._port.set_dtr(payload == b"\1")

    def step(self):
        """Read the port for a moment; end motion where the program has been silent for long."""
        data = self._port.read(MAX_PAYLOAD, READ_TIMEOUT)
        if data:
            self._tell(frame(READ, data))
        with self._lock:
            silent = self._silence is not None and self._clock() - self._heard > self._silence
            if silent and not (self._at_rest or self.ended):
                self._at_rest = True
                self._port.write(self._farewell)

    def run(self):
        """Read until it ends or the connection is lost."""
        try:
            while not self.ended:
                self.step()
        except ConnectionLost as error:
            with contextlib.suppress(OSError):
                self._tell(failure(error))

    def close(self):
        """Write the farewell, where the device still hears it, and close the port."""
        self.ended = True
        with self._lock, contextlib.suppress(ConnectionLost):
            self._port.write(self._farewell)
        time.sleep(SENDING)
        self._port.close()


def failure(error):
    """Frame that tells the program of an error of this process."""
    told = [type(error).__name__, error.what, error.cause, error.step]
    return frame(FAILED, json.dumps(told).encode()[:MAX_PAYLOAD])


def main(words):
    """Keep a port: name, baud rate, farewell in hexadecimal digits, silence in seconds or 0."""
    name, baud, farewell, silence = words
    for number in ("SIGINT", "SIGHUP"):  # of the terminal: the program decides
        if hasattr(signal, number):
            signal.signal(getattr(signal, number), signal.SIG_IGN)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    commands, answers = sys.stdin.buffer, sys.stdout.buffer

    def tell(data):
        answers.write(data)
        answers.flush()

    try:
        port = open_port(name, int(baud))
    except PortError as error:
        tell(failure(error))
        return 1
    keeper = Keeper(port, bytes.fromhex(farewell), float(silence) or None, tell)
    try:
        tell(frame(OPENED))
        threading.Thread(target=_read, args=(keeper,), daemon=True).start()
        for kind, payload in frames(commands):
            keeper.take(kind, payload)
    except (ConnectionLost, OSError):
        pass  # the reading thread has told it, or nobody is left to be told
    finally:
        keeper.close()
    return 0


def _read(keeper):
    try:
        keeper.run()
    except OSError:  # nobody hears any more
        keeper.close()
        os._exit(0)
    if not keeper.ended:  # the port is lost: without it there is nothing to keep
        os._exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
