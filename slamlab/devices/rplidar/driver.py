"""RPLIDAR driver: connection, one scan per revolution, automatic reconnection, statistics."""

import threading
from collections import Counter

from slamlab.devices.back_pressure_queue import DropOldestQueue
from slamlab.devices.clock import Clock
from slamlab.devices.errors import (
    ConnectionLost,
    DataTimeout,
    DeviceNotResponding,
    SlamlabError,
    UnsupportedMode,
)
from slamlab.devices.reader_thread import ReaderThread
from slamlab.devices.reconnection import backoff
from slamlab.devices.rplidar.requests import NOMINAL_PWM
from slamlab.devices.rplidar.scan_modes import select_mode, standard_mode
from slamlab.devices.rplidar.session import Session
from slamlab.devices.serial_ports import find_lidar_port, find_port, split_baud, usb_identity
from slamlab.devices.shutdown import Closeable, close_at_exit
from slamlab.devices.transport import open_port

DEFAULT_PWM = NOMINAL_PWM  # duty cycle of the motor, 0 to 1023: about ten revolutions a second
BLIND = (
    "the lidar rotates but measures no distance: the cap is on, the laser is off, or no object is "
    "within the range of {:g} m. Check the window of the lidar"
)


class RPLidar(Closeable):
    """Driver of an RPLIDAR; it connects when it is created, and scans after :meth:`start`.

    A reader thread fills a bounded queue with the two newest revolutions. When the consumer is too
    slow, the queue drops the oldest revolution (back-pressure). Raises PortError,
    DeviceNotResponding, DeviceFault, ProtocolError or ConnectionLost.

    Parameters
    ----------
    port : str, such as /dev/ttyUSB0, COM3, socket://HOST:PORT; None finds its USB adapter; a baud
        rate can be appended, as in /dev/ttyUSB0@256000
    baud : int [bit/s], or None for baud-rate detection
    pwm : int, duty cycle of the motor, 0 to 1023; a lidar with speed control gets pwm / 660 of its
        recommended rotation rate
    reconnect : bool, whether to reconnect after a lost connection, such as after unplugging; the
        next revolution has ``after_gap``
    opener : callable(port, baud) -> Transport
    clock : Clock
    """

    def __init__(
        self, port=None, baud=None, pwm=DEFAULT_PWM, reconnect=False, opener=open_port, clock=None
    ):
        self.clock, self._opener = clock or Clock(), opener
        self.pwm, self.reconnect = pwm, reconnect
        self.name, named_baud = split_baud(port or "")
        self.name = self.name or find_lidar_port()
        self._usb_identity = usb_identity(self.name)
        self._commands, self._revolutions = threading.RLock(), DropOldestQueue(self.clock)
        self._counts, self._mode_warning = Counter(), ""
        self._reader = self._stream = self.mode = None
        self._closed = self._force = False
        session = Session(self.name, named_baud or baud, opener, self.clock)
        try:
            self.modes, self.typical = session.modes()
        except BaseException:
            session.close()
            raise
        self._session, self.info, self.health = session, session.info, session.health
        close_at_exit(self)

    def __repr__(self):
        return f"{self.info.name} on {self.name}, firmware {'{}.{:02}'.format(*self.info.firmware)}"

    def start(self, mode=None, force=False):
        """Start the motor and a scan; if a scan is already running, restart it.

        ``mode``: name or number of one of ``modes``, or None for the recommended mode; ``force``:
        whether to scan before the rotation is steady. The standard scan replaces a mode whose data
        type has no decoder (see ``warnings``). Raises UnsupportedMode, DeviceNotResponding,
        ConnectionLost.
        """
        wanted, warning = select_mode(self.modes, self.typical, mode)
        with self._commands:
            self._stop_scan()
            self._force = force
            try:
                self._start_scan(wanted)
            except (DeviceNotResponding, UnsupportedMode) as error:
                if mode is not None and isinstance(error, DeviceNotResponding):
                    raise
                self._session.link.stop_and_drain()
                wanted, warning = standard_mode(self.modes, error.what)
                self._start_scan(wanted)
            self._mode_warning = warning
            self._revolutions.start()
            self._reader = ReaderThread(
                self._step, f"reads {self.name}", self._revolutions.finish, self.clock
            )
            self._reader.start()

    def stop(self):
        """Stop the scan and the motor, but keep the connection open."""
        with self._commands:
            self._stop_scan()
            self._session.stop_motor()

    def revolution(self, latest=False, timeout=None):
        """Return the next or the latest Revolution; start a scan if none is running.

        Returns None if the lidar is closed or stopped during the wait. Raises ConnectionLost,
        ProtocolError, and DataTimeout after ``timeout`` [s].
        """
        self._ensure_started()
        received, revolution = self._revolutions.get(latest, timeout)
        if not received:
            raise DataTimeout(
                f"no complete revolution was received within {timeout:g} s",
                "the motor has not reached its speed, or the timeout is too short",
                "increase the timeout: a start takes up to 5 s, a revolution 0.1 s",
            )
        return revolution

    def __iter__(self):
        self._ensure_started()
        while (revolution := self._revolutions.get()[1]) is not None:
            yield revolution

    @property
    def baud(self):
        """The baud rate of the port, which was given or detected [bit/s]."""
        return self._session.baud

    @property
    def sensor(self):
        """SensorModel of the running scan mode; before a scan, of the recommended mode."""
        mode = self.mode or select_mode(self.modes, self.typical, None)[0]
        return mode.sensor(self.info)

    @property
    def warnings(self):
        """Sentences that describe the present faults of a lidar that still sends data."""
        blind = self._stream is not None and self._stream.blind
        found = [self._mode_warning, BLIND.format(self.mode.range_max) if blind else ""]
        return [warning for warning in found if warning]

    @property
    def stats(self):
        """Statistics, such as the numbers of revolutions, resynchronisations and dropped bytes."""
        queue = self._revolutions
        counts = Counter({"revolutions": queue.count, "revolutions dropped": queue.dropped})
        counts.update(self._counts)
        if self._stream is not None:
            counts.update(self._stream.counts)
        received = "revolutions", "revolutions dropped"
        damage = "resyncs", "bytes dropped", "bad checksums", "reconnects"
        return {name: counts[name] for name in (*received, *damage, "bytes")}

    def close(self):
        """Stop the scan and the motor, and close the port; repeated calls are safe."""
        acquired = self._commands.acquire(timeout=2.0)  # a signal handler must not wait for ever
        try:
            self._closed = True
            if self._reader is not None:
                self._reader.stop()
            self._session.close()
        finally:
            if acquired:
                self._commands.release()
        self._revolutions.finish()

    def _ensure_started(self):
        if self._reader is None and not self._closed:
            self.start()

    def _start_scan(self, mode, after_gap=False):
        stream = self._session.start_scan(mode, self.pwm, self._force, after_gap)
        if self._stream is not None:
            self._counts.update(self._stream.counts)
        self.mode, self._stream = mode, stream

    def _stop_scan(self):
        reader, self._reader = self._reader, None
        if reader is not None:
            reader.stop()
            self._revolutions.finish()
        if self._closed or self._session.link is None:
            raise ConnectionLost(
                f"the lidar on {self.name} is closed",
                "the program closed the connection, or the unplugged lidar is not reconnected yet",
                "connect to the lidar again",
            )
        if reader is not None:
            self._session.link.stop_and_drain()

    def _step(self, stopping):
        try:
            revolutions = self._stream.feed(*self._session.read())
        except ConnectionLost:
            if not self.reconnect or stopping.is_set():
                raise
            self._reconnect(stopping)
        else:
            self._revolutions.put(revolutions)

    def _reconnect(self, stopping):
        """Reconnect to the same lidar after unplugging, with exponential back-off."""
        baud = self._session.baud
        self._session.close()
        for _ in backoff(self.clock, stopping):
            self.name = find_port(self._usb_identity) or self.name
            try:
                self._session = Session(self.name, baud, self._opener, self.clock)
                if self._session.info.serial == self.info.serial:  # otherwise another lidar
                    self._start_scan(self.mode, after_gap=True)
                    self._counts["reconnects"] += 1
                    break
            except SlamlabError:
                pass
            self._session.close()
        if self._closed:  # meanwhile
            self._session.close()
