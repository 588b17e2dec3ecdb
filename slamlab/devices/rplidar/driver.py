"""RPLIDAR driver: connect, scan, take whole revolutions (turns), reconnect, close."""

import threading
from collections import Counter

from slamlab.devices.clock import Clock
from slamlab.devices.errors import (
    ConnectionLost,
    DataTimeout,
    DeviceNotResponding,
    SlamlabError,
)
from slamlab.devices.latest_value import LatestQueue
from slamlab.devices.reader_thread import ReaderThread, backoff
from slamlab.devices.rplidar.identification import BAUD_RATES
from slamlab.devices.rplidar.scan_modes import select_mode
from slamlab.devices.rplidar.session import Session
from slamlab.devices.serial_ports import find_lidar_port, find_port, usb_identity
from slamlab.devices.shutdown import close_at_exit
from slamlab.devices.transport import open_port

DEFAULT_PWM = 660  # duty cycle of the motor, 0 to 1023: about ten turns a second


class RPLidar:
    """Driver of an RPLIDAR on a port; connects at once, scans from :meth:`start`, :meth:`turn` on.

    One thread reads the port into a queue of the two newest whole turns (revolutions); on overflow
    the older ones are dropped, and counted in ``stats``. ``info``, ``health``, ``modes`` and
    ``typical`` are what it said of itself, ``mode`` is the one it scans in.

    Parameters
    ----------
    port : str, such as /dev/ttyUSB0, COM3, socket://HOST:PORT; None finds Slamtec's USB adapter
    baud : int, baud rate [bit/s], or None to try those that RPLIDARs have
    pwm : int, how fast the motor turns, 0 to 1023
    reconnect : bool, whether to reconnect, with back-off, after a lost connection; the first turn
        after that has ``after_gap``
    opener : callable(port, baud) -> Transport
    clock : Clock

    Raises
    ------
    PortError, DeviceNotResponding, DeviceFault, ProtocolError, ConnectionLost
    """

    def __init__(
        self, port=None, baud=115200, pwm=DEFAULT_PWM, reconnect=False, opener=open_port, clock=None
    ):
        self.clock, self._opener = clock or Clock(), opener
        self.pwm, self.reconnect = pwm, reconnect
        self.name = find_lidar_port() if port is None else port
        self._usb_identity = usb_identity(self.name)
        self._commands, self._turns = threading.RLock(), LatestQueue(self.clock)
        self._counts = Counter()
        self._reader = self._stream = self.mode = None
        self._closed = self._force = False
        session = Session(self.name, (baud,) if baud else BAUD_RATES, opener, self.clock)
        try:
            self.modes, self.typical = session.modes()
        except BaseException:
            session.close()
            raise
        self._session, self.info, self.health = session, session.info, session.health
        close_at_exit(self)

    def __repr__(self):
        return f"{self.info.name} on {self.name}, firmware {'{}.{}'.format(*self.info.firmware)}"

    def start(self, mode=None, force=False):
        """Start motor and scan; a scan that runs is started anew.

        Parameters
        ----------
        mode : str or int, one of ``modes`` by name or number; None for what the device recommends,
            or the standard scan where that fails
        force : bool, whether not to wait for an even rotation (standard scan only)

        Raises
        ------
        UnsupportedMode, DeviceNotResponding, ConnectionLost
        """
        wanted = select_mode(self.modes, self.typical, mode)
        with self._commands:
            self._stop_scan()
            self._force = force
            try:
                self._start_scan(wanted)
            except DeviceNotResponding:
                if mode is not None:
                    raise
                self._session.link.stop_and_drain()
                self._start_scan(select_mode(self.modes, self.typical, 0))
            self._turns.start()
            self._reader = ReaderThread(
                self._step, f"reads {self.name}", self._turns.finish, self.clock
            )
            self._reader.start()

    def stop(self):
        """Stop scan and motor; the connection stays."""
        with self._commands:
            self._stop_scan()
            self._session.stop_motor()

    def turn(self, latest=False, timeout=None):
        """Next whole turn (revolution), waited for; a lidar that stands is started.

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
        self._ensure_started()
        there, turn = self._turns.get(latest, timeout)
        if not there:
            raise DataTimeout(
                f"no whole turn within {timeout:g} s",
                "the motor has not come to speed, or turns are longer than that",
                "wait longer: a start takes up to 5 s, a turn 0.1 s",
            )
        return turn

    def __iter__(self):
        """Yield whole turns until the lidar is closed or stopped, by whomever."""
        self._ensure_started()
        while (turn := self._turns.get()[1]) is not None:
            yield turn

    @property
    def stats(self):
        """Statistics since it was opened: dict of what was received, dropped and damaged."""
        counts = Counter({"turns": self._turns.count, "turns dropped": self._turns.dropped})
        counts.update(self._counts)
        if self._stream is not None:
            counts.update(self._stream.counts)
        names = "turns", "turns dropped", "resyncs", "bytes dropped", "bad checksums", "reconnects"
        return {name: counts[name] for name in (*names, "bytes")}

    def close(self):
        """Stop scan and motor and close the port; may be called again."""
        got = self._commands.acquire(timeout=2.0)  # not for ever: a signal may come at any moment
        try:
            self._closed = True
            if self._reader is not None:
                self._reader.stop()
            self._session.close()
        finally:
            if got:
                self._commands.release()
        self._turns.finish()

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    def _ensure_started(self):
        if self._reader is None and not self._closed:
            self.start()

    def _start_scan(self, mode, after_gap=False):
        stream = self._session.start_scan(mode, self.pwm, self._force, after_gap)
        if self._stream is not None:
            self._counts.update(self._stream.counts)
        self.mode, self._stream = mode, stream

    def _stop_scan(self):
        """Stop the reader thread and the scan."""
        reader, self._reader = self._reader, None
        if reader is not None:
            reader.stop()
            self._turns.finish()
        if self._closed or self._session.link is None:
            raise ConnectionLost(
                f"the lidar on {self.name} is closed",
                "it was closed, or it was unplugged and has not reconnected yet",
                "open it anew",
            )
        if reader is not None:
            self._session.link.stop_and_drain()

    def _step(self, stopping):
        """One step of the reader thread."""
        try:
            turns = self._stream.feed(*self._session.read())
        except ConnectionLost:
            if not self.reconnect or stopping.is_set():
                raise
            self._reconnect(stopping)
        else:
            self._turns.put(turns)

    def _reconnect(self, stopping):
        """Reconnect with exponential back-off, until it is back or the driver is closed."""
        baud = self._session.baud
        self._session.close()
        for _ in backoff(self.clock, stopping):
            self.name = find_port(self._usb_identity) or self.name
            try:
                self._session = Session(self.name, (baud,), self._opener, self.clock)
                self._start_scan(self.mode, after_gap=True)
            except SlamlabError:
                self._session.close()
                continue
            self._counts["reconnects"] += 1
            break
        if self._closed:  # meanwhile
            self._session.close()
