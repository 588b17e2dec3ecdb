"""Device drivers for RPLIDAR and eMIR, with transports, protocols, emulators and recordings.

Read in this order:

- ``errors``: exceptions; ``transport``, ``serial_ports``: transport layer, port enumeration
- ``port_watchdog``, ``port_watchdog_client``: process that owns a port and stops the device
- ``clock``, ``shutdown``, ``reader_thread``, ``back_pressure_queue``, ``reconnection``
- ``rplidar``, ``emir``: protocols and drivers
- ``emulator``: emulated devices; ``recording``: raw recordings and their playback
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".rplidar": ["RPLidar"],
        ".emir": ["Calibration", "Emir"],
        ".recording": ["Recorder", "Recording"],
        ".errors": ["SlamlabError"],
    },
)
LIDARS = {"devices:": "RPLidar"}  # prefix of a source's name: driver class
