"""One connection with an RPLIDAR: opened, asked who it is, told to scan, let go."""

import contextlib

from slamlab.devices.errors import DeviceNotResponding, SlamlabError
from slamlab.devices.rplidar import connect
from slamlab.devices.rplidar.answers import Answer
from slamlab.devices.rplidar.link import MOST, Link
from slamlab.devices.rplidar.modes import ask_modes
from slamlab.devices.rplidar.requests import Command, express, motor_pwm, request
from slamlab.devices.rplidar.stream import DECODERS, Stream

POLL = 0.05  # how long a read waits [s]
BEGIN = 2.0  # for the descriptor of a scan [s]
AFTER_STOP = 0.1  # old firmware needs that long [s]


class Session:
    """An open port with an RPLIDAR behind it that is silent and healthy.

    Parameters
    ----------
    name : str, of the port
    bauds : speeds to try [bit/s]
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
                self.let_go()
                self.link = Link(opener(name, self.baud), clock)
                self.link.port.set_dtr(False)
                self.info = connect.identify(self.link)
                if self.info is not None:
                    break
            else:
                raise connect.not_responding(self.link, bauds)
            self.health = connect.healthy(self.link)
        except BaseException:
            self.let_go()
            raise

    def modes(self):
        """In which ways it can scan, and the recommended one: see :func:`ask_modes`."""
        return ask_modes(self.link, self.info)

    def begin(self, mode, pwm, force=False, after_gap=False):
        """Turn the motor and scan.

        Parameters
        ----------
        mode : Mode
        pwm : int, of the motor
        force : bool, whether not to wait for an even rotation, in the standard mode
        after_gap : bool, whether this continues a scan whose connection broke

        Returns
        -------
        Stream

        Raises
        ------
        DeviceNotResponding, ConnectionLost
        """
        link, scan = self.link, Command.FORCE_SCAN if force else Command.SCAN
        link.port.set_dtr(False)
        link.send(motor_pwm(pwm))
        data = request(scan) if mode.answer == Answer.SCAN else express(mode.number)
        finder, found = link.ask(data, DECODERS, BEGIN, loop=True)
        if found is None:
            raise DeviceNotResponding(
                f"the lidar does not begin to scan in mode {mode.name}",
                "its firmware does not have that mode, or it protects itself",
                "start it in mode 0, the standard scan, or plug it in anew",
            )
        answer, now = Answer(found[0].type), self._clock.now()
        stream = Stream(answer, mode.period, self.baud, now, after_gap)
        if finder.rest:
            stream.feed(finder.rest, now)
        return stream

    def read(self):
        """The bytes that have come, and when they were there [s]."""
        return self.link.port.read(MOST, POLL), self._clock.now()

    def rest(self):
        """Stop scan and motor; the port stays open."""
        self.link.quiet()
        self.link.send(motor_pwm(0))
        self.link.port.set_dtr(True)

    def let_go(self):
        """Stop scan and motor as far as they can be reached, close the port; may be repeated."""
        link = self.link
        if link is None:
            return
        with contextlib.suppress(SlamlabError):
            link.send(request(Command.STOP))
            self._clock.sleep(AFTER_STOP)
            link.send(motor_pwm(0))
            self._clock.sleep(0.01)
        link.port.set_dtr(True)
        link.port.close()
        self.link = None
