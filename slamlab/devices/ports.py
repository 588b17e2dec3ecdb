"""Which serial ports there are, and which of them an RPLIDAR hangs on."""

from serial.tools import list_ports

from slamlab.devices.errors import PortNotFound

LIDAR_USB = {(0x10C4, 0xEA60)}
"""Vendor and product of the CP2102 on Slamtec's USB adapter; other things have that chip, too."""


def ports():
    """Every serial port of this machine that says what it is.

    Returns
    -------
    list of pyserial's ListPortInfo: device, description, vid, pid, serial_number
    """
    return sorted(list_ports.comports(), key=lambda port: port.device)


def lidar_port(found=None):
    """The port that an RPLIDAR's USB adapter has.

    Parameters
    ----------
    found : list of ListPortInfo, or None for this machine's

    Returns
    -------
    str

    Raises
    ------
    PortNotFound : there is none, or there are several
    """
    found = ports() if found is None else found
    fitting = [port.device for port in found if (port.vid, port.pid) in LIDAR_USB]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        raise PortNotFound(
            f"{len(fitting)} ports may be the lidar's: {', '.join(fitting)}",
            "several USB adapters with the same chip are plugged in",
            "name one of them, or unplug the others",
        )
    raise PortNotFound(
        "no USB adapter of an RPLIDAR is plugged in",
        "the cable only carries power, or the adapter needs its driver (CP210x)",
        f"try another cable, or name the port; there are: "
        f"{', '.join(port.device for port in found) or 'none'}",
    )


def identity(name, found=None):
    """What a USB adapter is known by, whatever port it is given next time.

    Parameters
    ----------
    name : str, its port now
    found : list of ListPortInfo, or None for this machine's

    Returns
    -------
    (vid, pid, serial number) or None
    """
    for port in ports() if found is None else found:
        if port.device == name and port.serial_number:
            return port.vid, port.pid, port.serial_number
    return None


def port_of(known, found=None):
    """The port that a USB adapter has now.

    Parameters
    ----------
    known : result of :func:`identity`
    found : list of ListPortInfo, or None for this machine's

    Returns
    -------
    str, or None where it is not plugged in
    """
    if known is None:
        return None
    for port in ports() if found is None else found:
        if (port.vid, port.pid, port.serial_number) == known:
            return port.device
    return None
