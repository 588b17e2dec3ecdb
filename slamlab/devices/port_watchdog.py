"""Watchdog process (dead man's switch) that owns a port and stops the device.

The process sends the stop command when the client program ends, is killed, or has sent nothing
for the watchdog timeout. The command stops a robot or the motor of a lidar. The command watchdog
of eMIR is in ``emir.session``.
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

# Kinds of frames. To this process: WRITE, DTR. From it: OPENED or FAILED first, then READ, FAILED.
WRITE, DTR, OPENED, FAILED, READ = b"w", b"d", b"o", b"f", b"r"
MAX_PAYLOAD = 0xFFFF
READ_TIMEOUT = 0.05  # of one read of the port, and period of the watchdog check [s]
TRANSMISSION_TIME = 0.1  # for the stop command, before the port is closed [s]
_HEAD = struct.Struct("<cH")


def frame(kind, payload=b""):
    """Encode a frame: kind, length of the payload (16 bits, little endian), payload."""
    return _HEAD.pack(kind, len(payload)) + payload


def frames(pipe):
    """Yield each frame (kind, payload) that a binary pipe delivers."""
    while len(head := pipe.read(_HEAD.size)) == _HEAD.size:
        kind, size = _HEAD.unpack(head)
        payload = pipe.read(size)
        if len(payload) < size:
            return
        yield kind, payload


class PortWatchdog:
    """Owner of an open port: one thread reads the port, another thread handles client frames.

    ``stop_command``: bytes to write at the end, and when the client has written nothing for
    ``timeout`` [s]; ``timeout`` None: no watchdog timeout; ``send(bytes)``: function that sends a
    frame to the client.
    """

    def __init__(self, port, stop_command, timeout, send, clock=time.monotonic):
        self._port, self._stop_command, self._timeout = port, stop_command, timeout
        self._send, self._clock, self._lock = send, clock, threading.Lock()
        self._last_write, self._stopped, self.ended = clock(), True, False

    def handle(self, kind, payload):
        """Handle one frame that the client has sent."""
        if kind == WRITE:
            with self._lock:
                self._last_write, self._stopped = self._clock(), False
                self._port.write(payload)
        elif kind == DTR:
            self._port.set_dtr(payload == b"\1")

    def step(self):
        """Read the port once, and check whether the watchdog timeout is over."""
        data = self._port.read(MAX_PAYLOAD, READ_TIMEOUT)
        if data:
            self._send(frame(READ, data))
        with self._lock:
            elapsed = self._clock() - self._last_write
            expired = self._timeout is not None and elapsed > self._timeout
            if expired and not (self._stopped or self.ended):
                self._stopped = True
                self._port.write(self._stop_command)

    def run(self):
        """Read the port until the end; report to the client if the connection is lost."""
        try:
            while not self.ended:
                self.step()
        except ConnectionLost as error:
            with contextlib.suppress(OSError):
                self._send(failure_frame(error))

    def close(self):
        """Write the stop command and close the port."""
        self.ended = True
        with self._lock, contextlib.suppress(ConnectionLost):
            self._port.write(self._stop_command)
        time.sleep(TRANSMISSION_TIME)
        self._port.close()


def failure_frame(error):
    """Encode a SlamlabError as a frame for the client."""
    fields = [type(error).__name__, error.what, error.cause, error.step]
    return frame(FAILED, json.dumps(fields).encode()[:MAX_PAYLOAD])


def main(arguments):
    """Run with the arguments port, baud rate, stop command (hexadecimal), and timeout [s] or 0."""
    name, baud, stop_command, timeout = arguments
    for number in ("SIGINT", "SIGHUP"):  # from the terminal: the client program handles them
        if hasattr(signal, number):
            signal.signal(getattr(signal, number), signal.SIG_IGN)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    commands, answers = sys.stdin.buffer, sys.stdout.buffer

    def send(data):
        answers.write(data)
        answers.flush()

    try:
        port = open_port(name, int(baud))
    except PortError as error:
        send(failure_frame(error))
        return 1
    watchdog = PortWatchdog(port, bytes.fromhex(stop_command), float(timeout) or None, send)
    try:
        send(frame(OPENED))
        threading.Thread(target=_read, args=(watchdog,), daemon=True).start()
        for kind, payload in frames(commands):
            watchdog.handle(kind, payload)
    except (ConnectionLost, OSError):
        pass  # the reading thread has reported it, or the client has ended
    finally:
        watchdog.close()
    return 0


def _read(watchdog):
    try:
        watchdog.run()
    except OSError:  # the client has ended
        watchdog.close()
        os._exit(0)
    if not watchdog.ended:  # the port is lost
        os._exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
