"""One connection (session) with an eMIR: handshake, commands, keep-alive, watchdog, timeouts."""

import contextlib
import logging
import threading

from slamlab.devices.emir import commands
from slamlab.devices.emir.receiver import EmirReceiver
from slamlab.devices.errors import ConnectionLost, DeviceNotResponding, DeviceSilent, SlamlabError
from slamlab.devices.receive_timeout import ReceiveTimer

REPEAT_PERIOD = 0.2  # of the last command, as a keep-alive [s]
READ_TIMEOUT = 0.05  # of one read by the reader thread [s]
FIRST_STATUS_TIMEOUT = 2.0  # for the first status, in the handshake [s]
ASK_AGAIN = 0.4  # without a status after which the stream is requested again [s]
RECEIVE_TIMEOUT = 0.9  # without a status after which the connection counts as lost [s]
STOP_FRAMES = commands.stop(), commands.move(0, 0)  # commands of standstill: no watchdog

log = logging.getLogger(__name__)


class Session:
    """Session: an open port with an eMIR that stands still and sends its status.

    Parameters
    ----------
    name : str, of the port
    baud : int [bit/s]
    odometry : Odometry, advanced by what is heard
    watchdog : float, timeout after which a motion that is not renewed ends [s], or None: never
    opener : callable(name, baud) -> Transport
    clock : Clock

    ``watchdog_stops`` counts how often that stopped it.

    Raises
    ------
    PortError, DeviceNotResponding, ConnectionLost
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
        """Send a command that leaves its motion as it is.

        Parameters
        ----------
        frame : bytes

        Raises
        ------
        ConnectionLost
        """
        with self._writing:
            if self._closed:
                raise ConnectionLost(
                    f"eMIR on {self.name} is closed",
                    "it was closed, or it was lost and not yet found again",
                    "open it anew",
                )
            self._write(frame)

    def move(self, frame, repeated):
        """Send a motion command and renew the command watchdog.

        Parameters
        ----------
        frame : bytes
        repeated : bool, whether to repeat it (keep-alive), until the next such command

        Raises
        ------
        ConnectionLost
        """
        with self._writing:
            self.send(frame)
            self._repeated_frame = frame if repeated else None
            self.renew()

    def renew(self):
        """Renew the command watchdog: the present motion is still wanted."""
        self._renewed = self._clock.now()

    def step(self):
        """Read for a moment; repeat the command, check receive timeout and command watchdog.

        Returns
        -------
        int, how many statuses came

        Raises
        ------
        ConnectionLost
        """
        count, now = self._receive(), self._clock.now()
        if self._receive_timer.elapsed > RECEIVE_TIMEOUT:
            raise DeviceSilent(
                f"eMIR stopped sending {self._receive_timer.elapsed:.1f} s ago",
                "it is out of reach, switched off, or its battery is empty",
                "bring it near, check its battery, then open it anew",
            )
        with self._writing:
            if not self._closed:
                self._maintain(now)
        return count

    def close(self):
        """Close the port, after the robot was stopped where it can be; may be repeated."""
        self._closed = True  # from now on no motion command is sent
        if self._released:
            return
        with self._writing, contextlib.suppress(SlamlabError):
            self._write(commands.move(0, 0), commands.stop(), commands.info(False))
        self._clock.sleep(0.01)  # until it is sent; by then others may have the lock
        self._port.close()
        self._released = True  # a signal may have come on the way: then all of it is done again

    def _maintain(self, now):
        """Keep status and counters going, repeat the motion command or end it by the watchdog."""
        if min(self._receive_timer.elapsed, now - self._requested) > ASK_AGAIN:
            self._requested = now
            self._write(commands.info(True))
        if self.receiver.odometry.near_limit:
            log.info("eMIR's counters are reset before they saturate")
            self._write(commands.reset_counters())
        moves = self._repeated_frame is not None and self._repeated_frame not in STOP_FRAMES
        if moves and self._watchdog is not None and now - self._renewed > self._watchdog:
            log.warning("command watchdog: eMIR is stopped, nobody has renewed its motion")
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
        """Read and decode what came; number of statuses."""
        data, now = self._port.read(4096, READ_TIMEOUT), self._clock.now()
        count = self.receiver.received(data, now)
        self._receive_timer.update(now, count > 0)
        return count

    def _await_status(self):
        while not self._receive():
            if self._receive_timer.elapsed > FIRST_STATUS_TIMEOUT:
                raise DeviceNotResponding(
                    f"no eMIR answers on {self.name}",
                    "it is switched off, not paired, or this is another device's port",
                    "switch it on, check the port (Bluetooth: /dev/rfcomm0 or COMx)",
                )
