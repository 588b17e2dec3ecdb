"""One connection (session) with an RPLIDAR: open the port, handshake, start a scan, close."""

import contextlib

from slamlab.devices.errors import DeviceNotResponding, SlamlabError
from slamlab.devices.rplidar import identification
from slamlab.devices.rplidar.link import READ_SIZE, Link
from slamlab.devices.rplidar.requests import Command, express, motor_pwm, request
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_modes import query_modes
from slamlab.devices.rplidar.scan_stream import DECODERS, ScanStream

READ_TIMEOUT = 0.05  # of one read by the reader thread [s]
DESCRIPTOR_TIMEOUT = 2.0  # for the response descriptor of a scan [s]
STOP_DELAY = 0.1  # that old firmware needs after STOP [s]


class Session:
    """Session: an open port with an identified, healthy RPLIDAR that does not scan.

    Parameters
    ----------
    name : str, of the port
    bauds : baud rates to try [bit/s]
    opener : callable(name, baud) -> Transport
    clock : Clock

    Raises
    ------
    PortError, DeviceNotResponding, DeviceFault, ProtocolError, ConnectionLost
    """

    def __init__(self, name, bauds, opener, clock):
        self._clock, self.link = clock, None
        try:
            for self.baud in bauds:
                self.close()
                self.link = Link(opener(name, self.baud), clock)
                self.link.port.set_dtr(False)
                self.info = identification.identify(self.link)
                if self.info is not None:
                    break
            else:
                raise identification.not_responding_error(self.link, bauds)
            self.health = identification.check_health(self.link)
        except BaseException:
            self.close()
            raise

    def modes(self):
        """Supported scan modes, and the recommended one: see :func:`query_modes`."""
        return query_modes(self.link, self.info)

    def start_scan(self, mode, pwm, force=False, after_gap=False):
        """Start the motor and a scan.

        Parameters
        ----------
        mode : ScanMode
        pwm : int, of the motor
        force : bool, whether not to wait for an even rotation, in the standard mode
        after_gap : bool, whether this continues a scan whose connection broke

        Returns
        -------
        ScanStream

        Raises
        ------
        DeviceNotResponding, ConnectionLost
        """
        link, scan = self.link, Command.FORCE_SCAN if force else Command.SCAN
        link.port.set_dtr(False)
        link.send(motor_pwm(pwm))
        data = request(scan) if mode.answer_type == AnswerType.SCAN else express(mode.number)
        finder, found = link.query(data, DECODERS, DESCRIPTOR_TIMEOUT, loop=True)
        if found is None:
            raise DeviceNotResponding(
                f"the lidar does not start to scan in mode {mode.name}",
                "its firmware does not have that mode, or it protects itself",
                "start it in mode 0, the standard scan, or plug it in anew",
            )
        answer, now = AnswerType(found[0].type), self._clock.now()
        stream = ScanStream(answer, mode.period, self.baud, now, after_gap)
        if finder.rest:
            stream.feed(finder.rest, now)
        return stream

    def read(self):
        """Read the bytes that have come, and their arrival time [s]."""
        return self.link.port.read(READ_SIZE, READ_TIMEOUT), self._clock.now()

    def stop_motor(self):
        """Stop scan and motor; the port stays open."""
        self.link.stop_and_drain()
        self.link.send(motor_pwm(0))
        self.link.port.set_dtr(True)

    def close(self):
        """Close the port, after scan and motor were stopped where they can be; may be repeated."""
        link = self.link
        if link is None:
            return
        with contextlib.suppress(SlamlabError):
            link.send(request(Command.STOP))
            self._clock.sleep(STOP_DELAY)
            link.send(motor_pwm(0))
            self._clock.sleep(0.01)
        link.port.set_dtr(True)
        link.port.close()
        self.link = None
