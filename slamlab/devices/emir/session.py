"""One connection with an eMIR: handshake, keep-alive, command watchdog, receive timeout."""

import contextlib
import logging
import threading

from slamlab.devices.emir import commands
from slamlab.devices.emir.receiver import EmirReceiver
from slamlab.devices.errors import ConnectionLost, DeviceNotResponding, DeviceSilent, SlamlabError
from slamlab.devices.reader_thread import ReceiveTimer

REPEAT_PERIOD = 0.2  # of the last command, as a keep-alive [s]
READ_TIMEOUT = 0.05  # of one read by the reader thread [s]
FIRST_STATUS_TIMEOUT = 2.0  # for the first status, in the handshake [s]
REQUEST_PERIOD = 0.4  # without a status, after which the stream is requested again [s]
RECEIVE_TIMEOUT = 0.9  # without a status, after which the connection counts as lost [s]
STOP_FRAMES = commands.stop(), commands.move(0, 0)  # commands of standstill: no watchdog

log = logging.getLogger(__name__)


class Session:
    """An open port to an eMIR that is at rest and sends statuses; arguments as in :class:`Emir`.

    Raises PortError, DeviceNotResponding, ConnectionLost.
    """

    def __init__(self, name, baud, odometry, watchdog, opener, clock):
        self.name, self._clock, self._watchdog = name, clock, watchdog
        self.receiver, self.watchdog_stops = EmirReceiver(odometry, baud), 0
        self._closed, self._released, self._writing = False, False, threading.RLock()
        self._repeated_frame = None  # the command that is repeated
        self._sent = self._requested = self._renewed = clock.now()
        self._receive_timer = ReceiveTimer(self._sent)
        self._port = opener(name, baud)
        try:
            self._port.set_dtr(False)
            self._write(commands.stop(), commands.info(True))
            self._await_status()
        except BaseException:
            self._port.close()
            raise

    def send(self, frame):
        """Send a command that does not change the motion. Raises ConnectionLost."""
        with self._writing:
            if self._closed:
                raise ConnectionLost(
                    f"eMIR on {self.name} is closed",
                    "the program closed the connection, or the lost connection is not restored yet",
                    "connect to the robot again",
                )
            self._write(frame)

    def move(self, frame, repeated):
        """Send a motion command, once or repeatedly, and restart the watchdog timeout."""
        with self._writing:
            self.send(frame)
            self._repeated_frame = frame if repeated else None
            self.renew()

    def renew(self):
        self._renewed = self._clock.now()

    def step(self):
        """Read the port, repeat the command and check both timeouts; return the number of statuses.

        Raises ConnectionLost.
        """
        count, now = self._receive(), self._clock.now()
        if self._receive_timer.elapsed > RECEIVE_TIMEOUT:
            raise DeviceSilent(
                f"eMIR stopped sending {self._receive_timer.elapsed:.1f} s ago",
                "the robot is out of range, is switched off, or has an empty battery",
                "move the robot closer, check its battery, then connect to it again",
            )
        with self._writing:
            if not self._closed:
                self._maintain(now)
        return count

    def close(self):
        """Stop the robot and close the port; repeated calls are safe."""
        self._closed = True  # from now on no motion command is sent
        if self._released:
            return
        with self._writing, contextlib.suppress(SlamlabError):
            self._write(commands.move(0, 0), commands.stop(), commands.info(False))
        self._clock.sleep(0.01)  # until the command is sent; other threads may take the lock
        self._port.close()
        self._released = True  # after an interruption by a signal, close() is repeated

    def _maintain(self, now):
        if min(self._receive_timer.elapsed, now - self._requested) > REQUEST_PERIOD:
            self._requested = now
            self._write(commands.info(True))
        if self.receiver.odometry.near_limit:
            log.info("Resetting the counters of eMIR before they saturate.")
            self._write(commands.reset_counters())
        moves = self._repeated_frame is not None and self._repeated_frame not in STOP_FRAMES
        if moves and self._watchdog is not None and now - self._renewed > self._watchdog:
            log.warning("The command watchdog stops eMIR because its motion was not renewed.")
            self.watchdog_stops += 1
            self._repeated_frame = commands.stop()
            self._write(self._repeated_frame)
        elif self._repeated_frame is not None and now - self._sent >= REPEAT_PERIOD:
            self._write(self._repeated_frame)

    def _write(self, *frames):
        data = b"".join(frames)
        with self._writing:
            self._port.write(data)
            self.receiver.sent(data)
            self._sent = self._clock.now()

    def _receive(self):
        """Read and decode bytes, and return the number of statuses in them."""
        data, now = self._port.read(4096, READ_TIMEOUT), self._clock.now()
        count = self.receiver.received(data, now)
        self._receive_timer.update(now, count > 0)
        return count

    def _await_status(self):
        while not self._receive():
            if self._receive_timer.elapsed > FIRST_STATUS_TIMEOUT:
                raise DeviceNotResponding(
                    f"no eMIR responds on {self.name}",
                    "the robot is switched off or unpaired, or the port belongs to another device",
                    "switch the robot on and check the port (Bluetooth: /dev/rfcomm0 or COMx)",
                )
