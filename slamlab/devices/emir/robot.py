"""eMIR as one uses it: open it, drive, ask where it went, close it: then it stands."""

import threading
from collections import Counter

from slamlab.devices.clock import Clock
from slamlab.devices.closing import closed_at_exit
from slamlab.devices.emir import commands
from slamlab.devices.emir.odometry import Calibration, Odometry
from slamlab.devices.emir.session import Session
from slamlab.devices.errors import ConnectionLost, SlamlabError
from slamlab.devices.reader import Reader, retries
from slamlab.devices.transport import open_port

BAUD = 57600
PATIENCE = 2.0  # so long it drives on though nobody asks for it [s]


class Emir:
    """An eMIR on a port; connects at once, then reads its status all the time.

    One thread reads, adds up the way, and repeats the last command five times a second: a lost one
    does no harm, and a robot that stops without commands drives on. But none drives on for a
    program that has forgotten it: a motion that nobody has asked for longer than ``patience``, by
    :meth:`move`, :meth:`drive` or :meth:`renew`, ends. Whoever takes readings of :class:`Devices`
    renews it.

    Parameters
    ----------
    port : str, such as /dev/rfcomm0, COM4, socket://HOST:PORT
    baud : int [bit/s]
    calibration : Calibration
    saturates : bool, whether its counters stop at ±128 instead of running over; they are then set
        back in time
    patience : float, so long a motion lasts that nobody renews [s], or None: for ever
    reconnect : bool, whether a lost connection is tried again until it is back; the robot then
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
        patience=PATIENCE,
        reconnect=False,
        opener=open_port,
        clock=None,
    ):
        self.name, self.clock, self.reconnect = port, clock or Clock(), reconnect
        self.odometry = Odometry(calibration or Calibration(), saturates)
        self.error, self._closed = None, False
        self._counts, self._news = Counter(), threading.Condition()
        self._open = lambda: Session(port, baud, self.odometry, patience, opener, self.clock)
        self._session = self._open()
        self._reader = Reader(self._step, f"reads {port}", self._ended)
        self._reader.start()
        closed_at_exit(self)

    @property
    def status(self):
        """Status, the last one."""
        return self._session.listener.status

    @property
    def calibration(self):
        """Calibration, see there."""
        return self.odometry.calibration

    @property
    def pose(self):
        """(3,) where the counters say it is now, from where it was opened [m, m, rad]."""
        return self.pose_at(self.clock.now())

    def pose_at(self, time):
        """Where it was at a time: see :meth:`Odometry.pose_at`."""
        return self.odometry.pose_at(time)

    @property
    def stats(self):
        """dict: what was received and lost, and how often it was stopped as forgotten."""
        counts = self._counts + _counts(self._session)
        names = "frames", "bad frames", "bytes dropped", "forgotten", "reconnects"
        return {name: counts[name] for name in names}

    def move(self, v, omega):
        """Drive on and on, until the next command or until nobody renews it.

        Parameters
        ----------
        v, omega : float, speed and turn rate, −100 to 100 [%]

        Raises
        ------
        ConnectionLost
        """
        self._usable.move(commands.move(v, omega), repeated=True)

    def drive(self, v, omega):
        """Drive as :meth:`move` does.

        Parameters
        ----------
        v, omega : float, speed and turn rate, by this robot's calibration [m/s, rad/s]

        Raises
        ------
        ConnectionLost
        """
        self.move(*self.calibration.percent(v, omega))

    def renew(self):
        """Somebody is still there: the present motion may go on."""
        self._session.renew()

    def stop(self):
        """Stand still."""
        self._usable.move(commands.stop(), repeated=True)

    def translate(self, way, speed=50):
        """Drive a way and stand still: see :func:`commands.translate`; does not wait for it."""
        self._usable.move(commands.translate(way, speed), repeated=False)

    def rotate(self, degrees, speed=50):
        """Turn by an angle and stand still: see :func:`commands.rotate`; does not wait for it."""
        self._usable.move(commands.rotate(degrees, speed), repeated=False)

    def beep(self, seconds=0.2):
        """Beep [s]."""
        self._usable.say(commands.beep(seconds))

    def reset(self):
        """Set the counters to 0; the pose goes on, no way is lost."""
        self._usable.say(commands.reset_counters())

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
        self._closed = True
        self._session.let_go()
        self._reader.stop()
        self._session.let_go()  # of one that came back meanwhile
        self._ended(None)

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    @property
    def _usable(self):
        """Session, unless its connection is lost."""
        if self.error is not None:
            raise self.error
        return self._session

    def _step(self, stopping):
        """What the reading thread does, again and again."""
        try:
            count = self._session.step()
        except ConnectionLost:
            if not self.reconnect or self._closed:
                raise
            self._connect_again(stopping)
            return
        with self._news:
            self._counts["frames"] += count
            self._news.notify_all()

    def _connect_again(self, stopping):
        """Try until the connection is back or nobody wants it any more."""
        self._session.let_go()
        for _ in retries(self.clock, stopping):
            self.odometry.expect_gap()
            try:
                session = self._open()
            except SlamlabError:
                continue
            self._counts += _counts(self._session) + Counter(reconnects=1)
            self._session = session
            break
        if self._closed:  # meanwhile
            self._session.let_go()

    def _ended(self, error):
        with self._news:
            if not self._closed:
                self.error = error or self.error
            self._news.notify_all()


def _counts(session):
    return session.listener.damage + Counter(forgotten=session.forgotten)
