"""One connection with an RPLIDAR: baud-rate detection, handshake, start of a scan, closing."""

import contextlib

from slamlab.devices.errors import (
    DeviceNotResponding,
    PortError,
    ProtocolError,
    SlamlabError,
    UnsupportedMode,
)
from slamlab.devices.rplidar import identification
from slamlab.devices.rplidar.link import READ_SIZE, Link
from slamlab.devices.rplidar.requests import (
    NOMINAL_PWM,
    NOMINAL_RPM,
    Command,
    Conf,
    express,
    motor_pwm,
    motor_speed,
    request,
)
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_modes import query_conf, query_modes
from slamlab.devices.rplidar.scan_stream import DECODERS, ScanStream

READ_TIMEOUT = 0.05  # of one read by the reader thread [s]
DESCRIPTOR_TIMEOUT = 2.0  # for the response descriptor of a scan [s]
ANY_TYPE = range(256)  # of descriptors
STOP_DELAY = 0.1  # required by old firmware after STOP [s]


class Session:
    """An open port to a healthy RPLIDAR that does not scan; ``baud`` None: baud-rate detection.

    Raises PortError, DeviceNotResponding, DeviceFault, ProtocolError, ConnectionLost.
    """

    def __init__(self, name, baud, opener, clock):
        self._clock, self._opener, self.link = clock, opener, None
        self.info = self._rpm = None
        try:
            self.info = self._detect_baud_rate(name, identification.connection_attempts(name, baud))
            self.health = identification.check_health(self.link)
        except BaseException:
            self.close()
            raise

    def _detect_baud_rate(self, name, attempts):
        """Baud-rate detection: return the Info at the first baud rate at which a lidar responds."""
        bauds, refused, received = list(dict.fromkeys(baud for _, baud in attempts)), set(), b""
        for timeout, baud in attempts:
            try:
                self._open(name, baud)
            except PortError as error:  # the adapter or its driver may not support this rate
                refused.add(baud)
                if type(error) is not PortError or len(refused) == len(bauds):
                    raise
                continue
            info = identification.identify(self.link, timeout, detecting=len(bauds) > 1)
            if info is not None:
                return info
            received += self.link.last_bytes
        tried = [baud for baud in bauds if baud not in refused]
        raise identification.not_responding_error(name, received, tried)

    def _open(self, name, baud):
        """Open the port at a baud rate, unless it is already open at this rate."""
        if self.link is not None and self.baud != baud:
            self.link.port.close()
            self.link = None
        if self.link is None:
            self.link, self.baud = Link(self._opener(name, baud), self._clock), baud
            self.link.port.set_dtr(False)

    def modes(self):
        return query_modes(self.link, self.info)

    def start_scan(self, mode, pwm, force=False, after_gap=False):
        """Start the motor and a scan, and return the ScanStream.

        Raises DeviceNotResponding, UnsupportedMode, ConnectionLost.
        """
        link, scan = self.link, Command.FORCE_SCAN if force else Command.SCAN
        link.port.set_dtr(False)
        link.send(self._motor(pwm))
        data = request(scan) if mode.answer_type == AnswerType.SCAN else express(mode.number)
        finder, found = link.query(data, ANY_TYPE, DESCRIPTOR_TIMEOUT, loop=True)
        if found is None:
            raise DeviceNotResponding(
                f"the lidar does not start a scan in mode {mode.name}",
                "the firmware does not support the mode, or a protection stop is active",
                "start the scan in mode 0, the standard scan, or unplug and reconnect the lidar",
            )
        answer, now = found[0].type, self._clock.now()
        if answer not in DECODERS or DECODERS[answer].size != found[0].length:
            raise UnsupportedMode(
                f"the lidar sends data of an unknown type in mode {mode.name} "
                f"(0x{answer:02X}, {found[0].length} bytes)",
                "the firmware is newer than this version of slamlab",
                "start the scan in mode 0, the standard scan",
            )
        stream = ScanStream(answer, mode.period, self.baud, now, after_gap)
        if finder.rest:
            stream.feed(finder.rest, now)
        return stream

    def read(self):
        """Read bytes, and return the bytes and their time of arrival [s]."""
        return self.link.port.read(READ_SIZE, READ_TIMEOUT), self._clock.now()

    def stop_motor(self):
        self.link.stop_and_drain()
        self.link.send(self._motor(0))
        self.link.port.set_dtr(True)

    def _motor(self, pwm):
        """Encode a duty cycle, or the equivalent rotation rate for a lidar with speed control."""
        if self.info is None or not self.info.controls_motor:
            return motor_pwm(pwm)
        if pwm and self._rpm is None:
            self._rpm = NOMINAL_RPM
            with contextlib.suppress(ProtocolError, DeviceNotResponding):
                self._rpm = query_conf(self.link, Conf.DESIRED_ROTATION)
        return motor_speed(round((self._rpm or 0) * pwm / NOMINAL_PWM))

    def close(self):
        """Stop the scan and the motor, and close the port; repeated calls are safe."""
        link = self.link
        if link is None:
            return
        with contextlib.suppress(SlamlabError):
            link.send(request(Command.STOP))
            self._clock.sleep(STOP_DELAY)
            link.send(self._motor(0))
            self._clock.sleep(0.01)
        link.port.set_dtr(True)
        link.port.close()
        self.link = None
