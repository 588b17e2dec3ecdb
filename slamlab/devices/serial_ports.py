"""Serial port discovery: list the ports, find the RPLIDAR's USB adapter, recognise it again."""

from serial.tools import list_ports

from slamlab.devices.errors import PortNotFound

LIDAR_USB_IDS = {(0x10C4, 0xEA60)}
"""USB vendor and product id of the CP2102 on Slamtec's adapter; other devices have it, too."""


def ports():
    """List the serial ports of this machine.

    Returns
    -------
    list of pyserial's ListPortInfo: device, description, vid, pid, serial_number
    """
    return sorted(list_ports.comports(), key=lambda port: port.device)


def find_lidar_port(found=None):
    """Find the serial port of an RPLIDAR's USB adapter.

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
    fitting = [port.device for port in found if (port.vid, port.pid) in LIDAR_USB_IDS]
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


def usb_identity(name, found=None):
    """USB identity (vendor, product, serial number) of the adapter on a port, to reconnect to it.

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


def find_port(identity, found=None):
    """Find the port that a USB adapter has now, after it was plugged in again.

    Parameters
    ----------
    identity : result of :func:`usb_identity`
    found : list of ListPortInfo, or None for this machine's

    Returns
    -------
    str, or None where it is not plugged in
    """
    if identity is None:
        return None
    for port in ports() if found is None else found:
        if (port.vid, port.pid, port.serial_number) == identity:
            return port.device
    return None
