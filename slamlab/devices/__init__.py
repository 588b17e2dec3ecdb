"""Device drivers for RPLIDAR and eMIR: ports, protocols, emulators, recordings of every byte.

Read in this order:

- ``transport``: serial port, TCP connection; ``serial_ports``, ``memory_port``; ``errors``,
  ``port_open_errors``: what can go wrong, and what to do
- ``kept_port``: a port in a process of its own, ``port_keeper``, which outlives a killed program
- ``reader_thread``, ``latest_value``, ``receive_timeout``, ``clock``, ``shutdown``: thread, queue,
  timeouts and safe end of both drivers
- ``rplidar``: the lidar's protocol and driver ``RPLidar``; ``emir``: the robot's, ``Emir``
- ``deskewing``: motion compensation of a scan taken on the move
- ``emulator``: both devices emulated; ``recording``: raw bytes recorded and replayed

As a source of readings they are in :mod:`slamlab.sources`.
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
