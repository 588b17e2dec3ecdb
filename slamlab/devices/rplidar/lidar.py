"""The RPLIDAR as one uses it: open it, take whole turns, close it."""

import threading
from collections import Counter

from slamlab.devices.clock import Clock
from slamlab.devices.closing import closed_at_exit
from slamlab.devices.errors import (
    ConnectionLost,
    DataTimeout,
    DeviceNotResponding,
    SlamlabError,
)
from slamlab.devices.newest import Newest
from slamlab.devices.ports import identity, lidar_port, port_of
from slamlab.devices.reader import Reader, retries
from slamlab.devices.rplidar.connect import BAUDS
from slamlab.devices.rplidar.modes import chosen
from slamlab.devices.rplidar.session import Session
from slamlab.devices.transport import open_port

PWM = 660  # about ten turns a second


class Lidar:
    """An RPLIDAR on a port; connects at once, turns from :meth:`start` or :meth:`turn` on.

    One thread reads the port and keeps the two newest whole turns; who comes late finds the older
    ones dropped, and counted in ``stats``. ``info``, ``health``, ``modes`` and ``typical`` are what
    it said of itself, ``mode`` is the one it scans in.

    Parameters
    ----------
    port : str, such as /dev/ttyUSB0, COM3, socket://HOST:PORT; None finds Slamtec's USB adapter
    baud : int [bit/s], or None to try those that RPLIDARs have
    pwm : int, how fast the motor turns, 0 to 1023
    reconnect : bool, whether a lost connection is tried again until it is back; the first turn
        after it has ``after_gap``
    opener : callable(port, baud) -> Transport
    clock : Clock

    Raises
    ------
    PortError, DeviceNotResponding, DeviceFault, ProtocolError, ConnectionLost
    """

    def __init__(
        self, port=None, baud=115200, pwm=PWM, reconnect=False, opener=open_port, clock=None
    ):
        self.clock, self._opener = clock or Clock(), opener
        self.pwm, self.reconnect = pwm, reconnect
        self.name = lidar_port() if port is None else port
        self._identity = identity(self.name)
        self._commands, self._turns, self._counts = threading.RLock(), Newest(), Counter()
        self._reader = self._stream = self.mode = None
        self._closed = self._force = False
        session = Session(self.name, (baud,) if baud else BAUDS, opener, self.clock)
        try:
            self.modes, self.typical = session.modes()
        except BaseException:
            session.let_go()
            raise
        self._session, self.info, self.health = session, session.info, session.health
        closed_at_exit(self)

    def __repr__(self):
        return f"{self.info.name} on {self.name}, firmware {'{}.{}'.format(*self.info.firmware)}"

    def start(self, mode=None, force=False):
        """Turn the motor and scan; a scan that runs is begun anew.

        Parameters
        ----------
        mode : str or int, one of ``modes`` by name or number; None for what the device recommends,
            or the standard scan where that fails
        force : bool, whether not to wait for an even rotation (standard scan only)

        Raises
        ------
        UnsupportedMode, DeviceNotResponding, ConnectionLost
        """
        wanted = chosen(self.modes, self.typical, mode)
        with self._commands:
            self._halt()
            self._force = force
            try:
                self._begin(wanted)
            except DeviceNotResponding:
                if mode is not None:
                    raise
                self._session.link.quiet()
                self._begin(chosen(self.modes, self.typical, 0))
            self._turns.begin()
            self._reader = Reader(self._step, f"reads {self.name}", self._turns.end)
            self._reader.start()

    def stop(self):
        """Stop scanning and the motor; the connection stays."""
        with self._commands:
            self._halt()
            self._session.rest()

    def turn(self, latest=False, timeout=None):
        """The next whole turn, waited for; a lidar that stands is started.

        Parameters
        ----------
        latest : bool, whether older ones that wait are skipped
        timeout : float, how long to wait [s]; None waits: the lidar's silence is an error anyway

        Returns
        -------
        Turn, or None when the lidar was closed or stopped meanwhile

        Raises
        ------
        ConnectionLost, DataTimeout, ProtocolError
        """
        self._started()
        there, turn = self._turns.take(latest, timeout)
        if not there:
            raise DataTimeout(
                f"no whole turn within {timeout:g} s",
                "the motor has not come to speed, or turns are longer than that",
                "wait longer: a start takes up to 5 s, a turn 0.1 s",
            )
        return turn

    def __iter__(self):
        """Yield whole turns until the lidar is closed or stopped, by whomever."""
        self._started()
        while (turn := self._turns.take()[1]) is not None:
            yield turn

    @property
    def stats(self):
        """dict: what was received and what was lost, since it was opened."""
        counts = Counter({"turns": self._turns.count, "turns dropped": self._turns.dropped})
        counts.update(self._counts)
        if self._stream is not None:
            counts.update(self._stream.counts)
        names = "turns", "turns dropped", "resyncs", "bytes dropped", "bad checksums", "reconnects"
        return {name: counts[name] for name in (*names, "bytes")}

    def close(self):
        """Stop scan and motor and let go of the port; may be called again."""
        got = self._commands.acquire(timeout=2.0)  # not for ever: a signal may come at any moment
        try:
            self._closed = True
            if self._reader is not None:
                self._reader.stop()
            self._session.let_go()
        finally:
            if got:
                self._commands.release()
        self._turns.end()

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    def _started(self):
        if self._reader is None and not self._closed:
            self.start()

    def _begin(self, mode, after_gap=False):
        stream = self._session.begin(mode, self.pwm, self._force, after_gap)
        if self._stream is not None:
            self._counts.update(self._stream.counts)
        self.mode, self._stream = mode, stream

    def _halt(self):
        """End the reading thread and the scan."""
        reader, self._reader = self._reader, None
        if reader is not None:
            reader.stop()
            self._turns.end()
        if self._closed or self._session.link is None:
            raise ConnectionLost(
                f"the lidar on {self.name} is closed",
                "it was closed, or it was unplugged and not yet found again",
                "open it anew",
            )
        if reader is not None:
            self._session.link.quiet()

    def _step(self, stopping):
        """What the reading thread does, again and again."""
        try:
            turns = self._stream.feed(*self._session.read())
        except ConnectionLost:
            if not self.reconnect or stopping.is_set():
                raise
            self._connect_again(stopping)
        else:
            self._turns.put(turns)

    def _connect_again(self, stopping):
        """Try until the connection is back or nobody wants it any more."""
        baud = self._session.baud
        self._session.let_go()
        for _ in retries(self.clock, stopping):
            self.name = port_of(self._identity) or self.name
            try:
                self._session = Session(self.name, (baud,), self._opener, self.clock)
                self._begin(self.mode, after_gap=True)
            except SlamlabError:
                self._session.let_go()
                continue
            self._counts["reconnects"] += 1
            break
        if self._closed:  # meanwhile
            self._session.let_go()
