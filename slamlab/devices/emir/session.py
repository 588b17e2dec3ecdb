"""One connection with an eMIR: opened, told what to do again and again, listened to, let go."""

import contextlib
import logging
import threading

from slamlab.devices.emir import commands
from slamlab.devices.emir.listener import EmirListener
from slamlab.devices.errors import ConnectionLost, DeviceNotResponding, DeviceSilent, SlamlabError
from slamlab.devices.silence import Silence

REFRESH = 0.2  # a command is repeated this often [s]
POLL = 0.05  # how long a read waits [s]
FIRST = 2.0  # for the first status [s]
ASK = 0.4  # without a status it is asked for again [s]
STEADY = 0.9  # without one the connection is taken for lost [s]
STANDS = commands.stop(), commands.move(0, 0)

log = logging.getLogger(__name__)


class Session:
    """An open port with an eMIR behind it that stands still and tells its status.

    Parameters
    ----------
    name : str, of the port
    baud : int [bit/s]
    odometry : Odometry, advanced by what is heard
    patience : float, so long a motion lasts that nobody renews [s], or None: for ever
    opener : callable(name, baud) -> Transport
    clock : Clock

    ``forgotten`` counts how often it was stopped for that.

    Raises
    ------
    PortError, DeviceNotResponding, ConnectionLost
    """

    def __init__(self, name, baud, odometry, patience, opener, clock):
        self.name, self._clock, self._patience = name, clock, patience
        self.listener, self.forgotten = EmirListener(odometry, baud), 0
        self._closed, self._gone, self._writing = False, False, threading.RLock()
        self._frame = None  # the command that is repeated
        self._sent = self._asked = self._wanted = clock.now()
        self._silence = Silence(self._sent)
        self._port = opener(name, baud)
        try:
            self._port.set_dtr(False)
            self._send(commands.stop(), commands.info(True))
            self._await_status()
        except BaseException:
            self._port.close()
            raise

    def say(self, frame):
        """Tell it something; its motion goes on.

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
            self._send(frame)

    def move(self, frame, repeated):
        """Tell it how to move.

        Parameters
        ----------
        frame : bytes
        repeated : bool, whether to say it again and again, until the next such command

        Raises
        ------
        ConnectionLost
        """
        with self._writing:
            self.say(frame)
            self._frame = frame if repeated else None
            self.renew()

    def renew(self):
        """The present motion is still wanted."""
        self._wanted = self._clock.now()

    def step(self):
        """Read for a moment, and say what is to be said again.

        Returns
        -------
        int, how many statuses came

        Raises
        ------
        ConnectionLost
        """
        count, now = self._take(), self._clock.now()
        if self._silence.seconds > STEADY:
            raise DeviceSilent(
                f"eMIR ceased to send, {self._silence.seconds:.1f} s ago",
                "it is out of reach, switched off, or its battery is empty",
                "bring it near, check its battery, then open it anew",
            )
        with self._writing:
            if not self._closed:
                self._keep(now)
        return count

    def let_go(self):
        """Stop the robot as far as it can be reached, close the port; may be repeated."""
        self._closed = True  # from now on nobody sets it going
        if self._gone:
            return
        with self._writing, contextlib.suppress(SlamlabError):
            self._send(commands.move(0, 0), commands.stop(), commands.info(False))
            self._clock.sleep(0.01)
        self._port.close()
        self._gone = True  # a signal may have come on the way: then all of it is done again

    def _keep(self, now):
        """Keep it telling, its counters off their ends, its motion going or ended."""
        if self._silence.seconds > ASK and now - self._asked > ASK:
            self._asked = now
            self._send(commands.info(True))
        if self.listener.odometry.full:
            log.info("eMIR's counters are set back before they stop at their end")
            self._send(commands.reset_counters())
        moves = self._frame is not None and self._frame not in STANDS
        if moves and self._patience is not None and now - self._wanted > self._patience:
            log.warning("eMIR is stopped: nobody has asked it to drive on")
            self.forgotten += 1
            self._frame = commands.stop()
            self._send(self._frame)
        elif self._frame is not None and now - self._sent >= REFRESH:
            self._send(self._frame)

    def _send(self, *frames):
        data = b"".join(frames)
        with self._writing:
            self._port.write(data)
            self.listener.told(data)
            self._sent = self._clock.now()

    def _take(self):
        """Read, and take in what came; how many statuses that were."""
        data, now = self._port.read(4096, POLL), self._clock.now()
        count = self.listener.hear(data, now)
        self._silence.listened(now, count > 0)
        return count

    def _await_status(self):
        while not self._take():
            if self._silence.seconds > FIRST:
                raise DeviceNotResponding(
                    f"no eMIR answers on {self.name}",
                    "it is switched off, not paired, or this is another device's port",
                    "switch it on, check the port (Bluetooth: /dev/rfcomm0 or COMx)",
                )
