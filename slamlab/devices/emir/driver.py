"""eMIR driver: connect, drive, wheel odometry, command watchdog, reconnect, stop on close."""

import threading
from collections import Counter

from slamlab.devices.clock import Clock
from slamlab.devices.emir import commands
from slamlab.devices.emir.session import Session
from slamlab.devices.emir.wheel_odometry import Calibration, Odometry
from slamlab.devices.errors import ConnectionLost, SlamlabError
from slamlab.devices.reader_thread import ReaderThread, backoff
from slamlab.devices.shutdown import close_at_exit
from slamlab.devices.transport import open_port

BAUD = 57600  # baud rate of the robot [bit/s]
WATCHDOG_TIMEOUT = 2.0  # command watchdog: a motion that is not renewed for so long ends [s]


class Emir:
    """Driver of an eMIR on a port; connects at once, then reads its status all the time.

    One thread reads, integrates odometry (dead reckoning), and repeats the last command five times
    a second (keep-alive): a lost one does no harm, and a robot that stops without commands drives
    on. A command watchdog stops it for a program that has forgotten it: a motion not asked for
    longer than ``watchdog``, by :meth:`move`, :meth:`drive` or :meth:`renew`, ends. Whoever takes
    readings of :class:`LiveDevices` renews it.

    Parameters
    ----------
    port : str, such as /dev/rfcomm0, COM4, socket://HOST:PORT
    baud : int, baud rate [bit/s]
    calibration : Calibration
    saturates : bool, whether its counters stop at ±128 instead of running over; they are then set
        back in time
    watchdog : float, timeout after which a motion that is not renewed ends [s], or None: never
    reconnect : bool, whether to reconnect, with back-off, after a lost connection; the robot then
        stands, and its way meanwhile is what its counters tell
    opener : callable(port, baud) -> Transport
    clock : Clock

    Raises
    ------
    PortError, DeviceNotResponding, ConnectionLost
    """

    def __init__(
        self,
        port,
        baud=BAUD,
        calibration=None,
        saturates=False,
        watchdog=WATCHDOG_TIMEOUT,
        reconnect=False,
        opener=open_port,
        clock=None,
    ):
        self.name, self.clock, self.reconnect = port, clock or Clock(), reconnect
        self.odometry = Odometry(calibration or Calibration(), saturates)
        self.error, self._closed = None, False
        self._counts, self._status_changed = Counter(), threading.Condition()
        arguments = port, baud, self.odometry, watchdog, opener, self.clock
        self._open_session = lambda: Session(*arguments)
        self._session = self._open_session()
        self._reader = ReaderThread(self._step, f"reads {port}", self._on_reader_end, self.clock)
        self._reader.start()
        close_at_exit(self)

    @property
    def status(self):
        """Last status received."""
        return self._session.receiver.status

    @property
    def calibration(self):
        """Calibration of the odometry."""
        return self.odometry.calibration

    @property
    def pose(self):
        """Odometry pose now (dead reckoning), (3,), from where it was opened [m, m, rad]."""
        return self.pose_at(self.clock.now())

    def pose_at(self, time):
        """Odometry pose at a time: see :meth:`Odometry.pose_at`."""
        return self.odometry.pose_at(time)

    @property
    def stats(self):
        """Statistics: dict of frames received and lost; ``forgotten`` are stops by the watchdog."""
        counts = self._counts + _counts(self._session)
        names = "frames", "bad frames", "bytes dropped", "forgotten", "reconnects"
        return {name: counts[name] for name in names}

    def move(self, v, omega):
        """Drive with a speed and turn rate in percent, until the next command or the watchdog.

        Parameters
        ----------
        v, omega : float, speed and turn rate, −100 to 100 [%]

        Raises
        ------
        ConnectionLost
        """
        self._connected.move(commands.move(v, omega), repeated=True)

    def drive(self, v, omega):
        """Drive with a speed and turn rate in SI units, as :meth:`move` does.

        Parameters
        ----------
        v, omega : float, speed and turn rate, by this robot's calibration [m/s, rad/s]

        Raises
        ------
        ConnectionLost
        """
        self.move(*self.calibration.percent(v, omega))

    def renew(self):
        """Renew the command watchdog (keep-alive): the present motion may go on."""
        self._session.renew()

    def stop(self):
        """Stop the robot."""
        self._connected.move(commands.stop(), repeated=True)

    def translate(self, way, speed=50):
        """Drive a distance and stop: see :func:`commands.translate`; does not wait for it."""
        self._connected.move(commands.translate(way, speed), repeated=False)

    def rotate(self, degrees, speed=50):
        """Rotate by an angle and stop: see :func:`commands.rotate`; does not wait for it."""
        self._connected.move(commands.rotate(degrees, speed), repeated=False)

    def beep(self, seconds=0.2):
        """Beep [s]."""
        self._connected.send(commands.beep(seconds))

    def reset(self):
        """Reset the counters to 0; the odometry pose goes on, no way is lost."""
        self._connected.send(commands.reset_counters())

    def wait(self, timeout=1.0):
        """Wait for the next status.

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
        with self._status_changed:
            seen = self._counts["frames"]
            over = self.clock.wait_for(
                self._status_changed,
                lambda: self._counts["frames"] > seen or self._closed or self.error,
                timeout,
            )
            if self.error is not None:
                raise self.error
            return self.status if over and not self._closed else None

    def close(self):
        """Stop the robot and close the port; may be called again."""
        self._closed = True
        self._session.close()
        self._reader.stop()
        self._session.close()  # of one that came back meanwhile
        self._on_reader_end(None)

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    @property
    def _connected(self):
        """Session, unless its connection is lost: then the error is raised."""
        if self.error is not None:
            raise self.error
        return self._session

    def _step(self, stopping):
        """One step of the reader thread."""
        try:
            count = self._session.step()
        except ConnectionLost:
            if not self.reconnect or self._closed:
                raise
            self._reconnect(stopping)
            return
        with self._status_changed:
            self._counts["frames"] += count
            self._status_changed.notify_all()

    def _reconnect(self, stopping):
        """Reconnect with exponential back-off, until it is back or the driver is closed."""
        self._session.close()
        for _ in backoff(self.clock, stopping):
            self.odometry.expect_gap()
            try:
                session = self._open_session()
            except SlamlabError:
                continue
            self._counts += _counts(self._session) + Counter(reconnects=1)
            self._session = session
            break
        if self._closed:  # meanwhile
            self._session.close()

    def _on_reader_end(self, error):
        with self._status_changed:
            if not self._closed:
                self.error = error or self.error
            self._status_changed.notify_all()


def _counts(session):
    return session.receiver.damage + Counter(forgotten=session.watchdog_stops)
