"""eMIR driver: commands, wheel odometry, command watchdog, automatic reconnection."""

import threading
from collections import Counter

from slamlab.devices.clock import Clock
from slamlab.devices.emir import commands
from slamlab.devices.emir.session import Session
from slamlab.devices.emir.wheel_odometry import Calibration, Odometry
from slamlab.devices.errors import ConnectionLost, SlamlabError
from slamlab.devices.reader_thread import ReaderThread
from slamlab.devices.reconnection import backoff
from slamlab.devices.serial_ports import split_baud
from slamlab.devices.shutdown import Closeable, close_at_exit
from slamlab.devices.transport import open_port

BAUD = 57600  # baud rate of the robot [bit/s]
WATCHDOG_TIMEOUT = 2.0  # of the command watchdog: a motion that is not renewed ends [s]


class Emir(Closeable):
    """Driver of an eMIR; its thread reads statuses and repeats the last command (keep-alive).
    Raises PortError, DeviceNotResponding or ConnectionLost.

    Parameters
    ----------
    port : str, such as /dev/rfcomm0, COM4, socket://HOST:PORT; a baud rate can be appended, as in
        /dev/ttyUSB0@9600
    baud : int [bit/s]
    calibration : Calibration
    saturates : bool, whether the encoder counters saturate at ±128 instead of wrapping around
    watchdog : float, timeout after which a motion ends if :meth:`move`, :meth:`drive` or
        :meth:`renew` is not called [s]; None: no watchdog
    reconnect : bool, whether to reconnect after a lost connection; the robot is then at rest
    opener : callable(port, baud) -> Transport
    clock : Clock
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
        self.name, named_baud = split_baud(port)
        self.clock, self.reconnect = clock or Clock(), reconnect
        self.odometry = Odometry(calibration or Calibration(), saturates)
        self.error, self._closed = None, False
        self._counts, self._status_changed = Counter(), threading.Condition()
        arguments = (self.name, named_baud or baud, self.odometry, watchdog, opener, self.clock)
        self._open_session = lambda: Session(*arguments)
        self._session = self._open_session()
        self._reader = ReaderThread(
            self._step, f"reads {self.name}", self._on_reader_end, self.clock
        )
        self._reader.start()
        close_at_exit(self)

    @property
    def status(self):
        """Last status received."""
        return self._session.receiver.status

    @property
    def calibration(self):
        return self.odometry.calibration

    @property
    def pose(self):
        """Current odometry pose (dead reckoning), (3,), relative to the start [m, m, rad]."""
        return self.pose_at(self.clock.now())

    def pose_at(self, time):
        """See :meth:`Odometry.pose_at`."""
        return self.odometry.pose_at(time)

    @property
    def stats(self):
        """Numbers of frames, invalid frames, dropped bytes, watchdog stops and reconnections."""
        counts = self._counts + _counts(self._session)
        names = "frames", "bad frames", "bytes dropped", "watchdog stops", "reconnects"
        return {name: counts[name] for name in names}

    def move(self, v, omega):
        """Drive at a speed and a turn rate from −100 to 100 [%].

        A new command or the watchdog ends the motion. Raises ConnectionLost, like all commands.
        """
        self._connected.move(commands.move(v, omega), repeated=True)

    def drive(self, v, omega):
        """Drive like :meth:`move`, but with speed and turn rate in SI units [m/s, rad/s]."""
        self.move(*self.calibration.percent(v, omega))

    def renew(self):
        """Renew the command watchdog so that the motion continues."""
        self._session.renew()

    def stop(self):
        self._connected.move(commands.stop(), repeated=True)

    def translate(self, distance, speed=50):
        """Drive a distance [m], then stop; return at once, before the motion has ended."""
        self._connected.move(commands.translate(distance, speed), repeated=False)

    def rotate(self, degrees, speed=50):
        """Rotate by an angle [degree], then stop; return at once, before the motion has ended."""
        self._connected.move(commands.rotate(degrees, speed), repeated=False)

    def beep(self, seconds=0.2):
        self._connected.send(commands.beep(seconds))

    def reset(self):
        """Set the encoder counters to 0; the odometry pose does not change."""
        self._connected.send(commands.reset_counters())

    def wait(self, timeout=1.0):
        """Return the next Status, or None after the timeout [s] or if the driver is closed.

        Raises ConnectionLost.
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
        """Stop the robot and close the port; repeated calls are safe."""
        self._closed = True
        self._session.close()
        self._reader.stop()
        self._session.close()  # a session that was reconnected meanwhile
        self._on_reader_end(None)

    @property
    def _connected(self):
        if self.error is not None:
            raise self.error
        return self._session

    def _step(self, stopping):
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
        """Reconnect after a loss of the connection, with exponential back-off."""
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
    return session.receiver.damage + Counter({"watchdog stops": session.watchdog_stops})
