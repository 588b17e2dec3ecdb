"""eMIR as one uses it: open it, drive, ask where it went, close it: then it stands."""

import contextlib
import logging
import threading
from collections import Counter

from slamlab.devices.clock import Clock
from slamlab.devices.closing import closed_at_exit
from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import Framer
from slamlab.devices.emir.odometry import Calibration, Odometry
from slamlab.devices.emir.status import Status
from slamlab.devices.errors import ConnectionLost, DeviceNotResponding, DeviceSilent, SlamlabError
from slamlab.devices.reader import Reader
from slamlab.devices.transport import open_port

BAUD = 57600
REFRESH = 0.2  # a command is repeated this often [s]
POLL = 0.05  # how long a read waits [s]
FIRST = 2.0  # for the first status [s]
ASK = 0.4  # without a status it is asked for again [s]
STEADY = 0.9  # without one the connection is taken for lost [s]
FRAME = 36 * 10  # bits of a status on the line

log = logging.getLogger(__name__)


class Emir:
    """An eMIR on a port; connects at once, then reads its status all the time.

    One thread reads, adds up the way, and repeats the last command five times a second.

    Parameters
    ----------
    port : str, such as /dev/rfcomm0, COM4, socket://HOST:PORT
    baud : int [bit/s]
    calibration : Calibration
    saturates : bool, whether its counters stop at ±128 instead of running over; they are then set
        back in time
    opener : callable(port, baud) -> Transport
    clock : Clock

    Raises
    ------
    PortError, DeviceNotResponding, ConnectionLost
    """

    def __init__(
        self, port, baud=BAUD, calibration=None, saturates=False, opener=open_port, clock=None
    ):
        self.name, self.clock = port, clock or Clock()
        self.odometry = Odometry(calibration or Calibration(), saturates)
        self.status, self.error, self._closed, self._gone = None, None, False, False
        self._framer, self._counts = Framer(), Counter()
        self._writing, self._news = threading.RLock(), threading.Condition()
        self._frame = None  # the command that is repeated
        self._port = opener(port, baud)
        self._wire = FRAME / baud
        try:
            self._port.set_dtr(False)
            self._send(commands.stop(), commands.info(True))
            self._sent = self._asked = self._heard = self.clock.now()
            self._await_status()
        except BaseException:
            self._port.close()
            raise
        self._reader = Reader(self._step, f"reads {port}", self._ended)
        self._reader.start()
        closed_at_exit(self)

    @property
    def calibration(self):
        """Calibration, see there."""
        return self.odometry.calibration

    @property
    def pose(self):
        """(3,) where the counters say it is now, from where it was opened or reset [m, m, rad]."""
        return self.pose_at(self.clock.now())

    def pose_at(self, time):
        """Where it was at a time: see :meth:`Odometry.pose_at`."""
        return self.odometry.pose_at(time)

    @property
    def stats(self):
        """dict: frames taken in, and what was lost."""
        counts = self._counts + self._framer.damage
        return {name: counts[name] for name in ("frames", "bad frames", "bytes dropped")}

    def move(self, v, omega):
        """Drive on and on, until the next command.

        Parameters
        ----------
        v, omega : float, speed and turn rate, −100 to 100 [%]

        Raises
        ------
        ConnectionLost
        """
        self._command(commands.move(v, omega), repeated=True)

    def drive(self, v, omega):
        """Drive on and on.

        Parameters
        ----------
        v, omega : float, speed and turn rate, by this robot's calibration [m/s, rad/s]

        Raises
        ------
        ConnectionLost
        """
        self.move(*self.calibration.percent(v, omega))

    def stop(self):
        """Stand still."""
        self._command(commands.stop(), repeated=True)

    def translate(self, way, speed=50):
        """Drive a way and stand still: see :func:`commands.translate`; does not wait for it."""
        self._command(commands.translate(way, speed))

    def rotate(self, degrees, speed=50):
        """Turn by an angle and stand still: see :func:`commands.rotate`; does not wait for it."""
        self._command(commands.rotate(degrees, speed))

    def beep(self, seconds=0.2):
        """Beep [s]."""
        self._command(commands.beep(seconds))

    def reset(self):
        """Set the counters to 0; the pose goes on, no way is lost."""
        with self._writing:
            self._send(commands.reset_counters())
            for counter in (self.odometry.path, self.odometry.angle):
                counter.expect_reset()

    def wait(self, timeout=1.0):
        """The next status.

        Parameters
        ----------
        timeout : float [s]

        Returns
        -------
        Status, or None when none came or it was closed

        Raises
        ------
        ConnectionLost
        """
        with self._news:
            seen = self._counts["frames"]
            over = self._news.wait_for(
                lambda: self._counts["frames"] > seen or self._closed or self.error, timeout
            )
            if self.error is not None:
                raise self.error
            return self.status if over and not self._closed else None

    def close(self):
        """Stop the robot and let go of the port; may be called again."""
        self._closed = True  # from now on nobody sets it going
        if self._gone:
            return
        with self._writing, contextlib.suppress(SlamlabError):
            self._frame = None
            self._send(commands.move(0, 0), commands.stop(), commands.info(False))
            self.clock.sleep(0.01)
        self._reader.stop()
        self._port.close()
        self._gone = True  # a signal may have come on the way: then all of it is done again
        self._ended(None)

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    def _command(self, frame, repeated=False):
        if self.error is not None:
            raise self.error
        with self._writing:
            if self._closed:
                raise ConnectionLost(
                    f"eMIR on {self.name} is closed", "close() was called", "open it anew"
                )
            self._frame = frame if repeated else None
            self._send(frame)

    def _send(self, *frames):
        with self._writing:
            self._port.write(b"".join(frames))
            self._sent = self.clock.now()

    def _await_status(self):
        begin = self._sent
        while self.status is None:
            self._take()
            if self.clock.now() - begin > FIRST:
                raise DeviceNotResponding(
                    f"no eMIR answers on {self.name}",
                    "it is switched off, not paired, or this is another device's port",
                    "switch it on, check the port (Bluetooth: /dev/rfcomm0 or COMx)",
                )

    def _step(self, stopping):
        self._take()
        now = self.clock.now()
        if now - self._heard > STEADY:
            raise DeviceSilent(
                f"eMIR ceased to send, {now - self._heard:.1f} s ago",
                "it is out of reach, switched off, or its battery is empty",
                "bring it near, check its battery, then open it anew",
            )
        with self._writing:
            if self._frame is not None and now - self._sent >= REFRESH and not stopping.is_set():
                self._send(self._frame)

    def _take(self):
        """Read, and take in what came."""
        for content in self._framer.feed(self._port.read(4096, POLL)):
            now = self.clock.now()
            with self._news:
                self.status, self._heard = Status.unpack(content), now
                self.odometry.advance(self.status.path, self.status.angle, now - self._wire)
                self._counts["frames"] += 1
                self._news.notify_all()
        now = self.clock.now()
        if now - max(self._heard, self._asked) > ASK:
            self._asked = now
            self._send(commands.info(True))
        if self.odometry.path.full or self.odometry.angle.full:
            log.info("eMIR's counters are set back before they stop at their end")
            self.reset()

    def _ended(self, error):
        with self._news:
            self.error = error or self.error
            self._news.notify_all()
