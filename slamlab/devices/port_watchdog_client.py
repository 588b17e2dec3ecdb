"""Transport over a port that a watchdog process owns so that it can stop the device."""

import json
import os
import subprocess
import sys
import threading
from contextlib import suppress

from slamlab.devices import errors, port_watchdog
from slamlab.devices.emir import commands
from slamlab.devices.rplidar.requests import Command, motor_pwm, motor_speed, request
from slamlab.devices.transport import Transport, connection_lost

WATCHDOG_TIMEOUT = 1.0  # a robot stops when its program has written nothing for so long [s]
# by device: command that stops it, watchdog timeout [s] or None
STOP_COMMANDS = {
    "lidar": (request(Command.STOP) + motor_speed(0) + motor_pwm(0), None),
    "emir": (commands.move(0, 0) + commands.stop(), WATCHDOG_TIMEOUT),
}

EXIT_TIMEOUT = 5.0  # for the watchdog process to end by itself [s]


class WatchdogPort(Transport):
    """Port that a watchdog process keeps open.

    ``stop_command`` and ``timeout`` are those of :class:`PortWatchdog`. Raises PortError.
    """

    def __init__(self, name, baud, stop_command, timeout=None):
        self.name, self.baud = name, baud
        self._data, self._lost, self._changed = b"", None, threading.Condition()
        arguments = [name, str(baud), stop_command.hex(), str(timeout or 0)]
        self.process = subprocess.Popen(
            # -P: the current folder's modules are not imported
            [sys.executable, "-P", "-m", port_watchdog.__name__, *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,  # Ctrl-C reaches only the client program
        )
        self._answers = open(self.process.stdout.fileno(), "rb", closefd=False)  # noqa: SIM115
        kind, payload = next(port_watchdog.frames(self._answers), (None, b""))
        if kind != port_watchdog.OPENED:
            self.close()
            self.process.stdout.close()
            raise _error(payload) if kind else connection_lost(name, "its process has ended")
        threading.Thread(target=self._receive, name=f"receives {name}", daemon=True).start()

    def read(self, n, timeout):
        with self._changed:
            self._changed.wait_for(lambda: self._data or self._lost, timeout)
            if self._lost and not self._data:
                raise self._lost
            data, self._data = self._data[:n], self._data[n:]
            return data

    def write(self, data):
        self._send(port_watchdog.WRITE, bytes(data))

    def set_dtr(self, on):
        """Set DTR and return True, because only the watchdog process knows whether DTR exists."""
        self._send(port_watchdog.DTR, bytes([bool(on)]))
        return True

    def close(self):
        with suppress(OSError):
            self.process.stdin.close()
        try:
            self.process.wait(EXIT_TIMEOUT)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def _send(self, kind, payload):
        with self._changed:
            if self._lost:
                raise self._lost
        try:
            os.write(self.process.stdin.fileno(), port_watchdog.frame(kind, payload))
        except (OSError, ValueError) as error:  # the process has ended, or the port is closed
            raise connection_lost(self.name, error) from error

    def _receive(self):
        lost = None
        for kind, payload in port_watchdog.frames(self._answers):
            if kind == port_watchdog.FAILED:
                lost = _error(payload)
                break
            with self._changed:
                self._data += payload
                self._changed.notify_all()
        with self._changed:
            self._lost = lost or connection_lost(self.name, "its watchdog process ended")
            self._changed.notify_all()
        self.process.stdout.close()


def opener(channel):
    """Return a function (name, baud) that opens a WatchdogPort for "lidar" or "emir"."""
    return lambda name, baud: WatchdogPort(name, baud, *STOP_COMMANDS[channel])


def _error(payload):
    kind, *fields = json.loads(payload)
    return getattr(errors, kind)(*fields)
