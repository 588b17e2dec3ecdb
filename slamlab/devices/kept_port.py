"""Transport through a process of its own that owns the port, and leaves the device at rest.

Whatever becomes of this program, its end ends the pipe to :mod:`slamlab.devices.port_keeper`.
"""

import json
import os
import subprocess
import sys
import threading
from contextlib import suppress

from slamlab.devices import errors, port_keeper
from slamlab.devices.emir import commands
from slamlab.devices.rplidar.requests import Command, motor_pwm, request
from slamlab.devices.transport import Transport, connection_lost

SILENCE = 1.0  # without a word of its program after which a robot is stopped [s]
FAREWELLS = {
    "lidar": (request(Command.STOP) + motor_pwm(0), None),
    "emir": (commands.move(0, 0) + commands.stop(), SILENCE),
}
"""What leaves a device at rest, and after which silence of the program it is said, besides."""

CLOSING = 5.0  # [s] for the process to end by itself


class KeptPort(Transport):
    """Port that a process of its own has open.

    Parameters
    ----------
    name : str, of the port
    baud : int [bit/s]
    farewell : bytes, what leaves the device at rest
    silence : float, for how long nothing may be written before the farewell is [s], or None

    Raises
    ------
    PortNotFound, PortPermission, PortBusy, PortError
    """

    def __init__(self, name, baud, farewell, silence=None):
        self.name, self.baud = name, baud
        self._data, self._lost, self._changed = b"", None, threading.Condition()
        words = [name, str(baud), farewell.hex(), str(silence or 0)]
        self.process = subprocess.Popen(
            # -P: a module in this folder is no module of that process
            [sys.executable, "-P", "-m", port_keeper.__name__, *words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,  # Ctrl-C is for the program, which then says what to do
        )
        self._answers = open(self.process.stdout.fileno(), "rb", closefd=False)  # noqa: SIM115
        kind, told = next(port_keeper.frames(self._answers), (None, b""))
        if kind != port_keeper.OPENED:
            self.close()
            self.process.stdout.close()
            raise _error(told) if kind else connection_lost(name, "its process ended at once")
        threading.Thread(target=self._listen, name=f"hears {name}", daemon=True).start()

    def read(self, n, timeout):
        """See :meth:`Transport.read`."""
        with self._changed:
            self._changed.wait_for(lambda: self._data or self._lost, timeout)
            if self._lost and not self._data:
                raise self._lost
            data, self._data = self._data[:n], self._data[n:]
            return data

    def write(self, data):
        """See :meth:`Transport.write`."""
        self._tell(port_keeper.WRITE, bytes(data))

    def set_dtr(self, on):
        """See :meth:`Transport.set_dtr`; whether there is such a line only that process knows."""
        self._tell(port_keeper.DTR, bytes([bool(on)]))
        return True

    def close(self):
        """See :meth:`Transport.close`; the process writes its farewell and ends."""
        with suppress(OSError):
            self.process.stdin.close()
        try:
            self.process.wait(CLOSING)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def _tell(self, kind, payload):
        with self._changed:
            if self._lost:
                raise self._lost
        try:
            os.write(self.process.stdin.fileno(), port_keeper.frame(kind, payload))
        except (OSError, ValueError) as error:  # ended, or closed here
            raise connection_lost(self.name, error) from error

    def _listen(self):
        lost = None
        for kind, payload in port_keeper.frames(self._answers):
            if kind == port_keeper.FAILED:
                lost = _error(payload)
                break
            with self._changed:
                self._data += payload
                self._changed.notify_all()
        with self._changed:
            self._lost = lost or connection_lost(self.name, "the process that keeps it ended")
            self._changed.notify_all()
        self.process.stdout.close()


def opener(channel):
    """Opener of a device's port in a process of its own.

    Parameters
    ----------
    channel : str, "lidar" or "emir"

    Returns
    -------
    callable(name, baud) -> KeptPort, as drivers take it
    """
    return lambda name, baud: KeptPort(name, baud, *FAREWELLS[channel])


def _error(told):
    kind, *words = json.loads(told)
    return getattr(errors, kind)(*words)
