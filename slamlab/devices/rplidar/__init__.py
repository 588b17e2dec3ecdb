"""Driver and protocol of the RPLIDAR, Slamtec's laser scanner (lidar).

Read in this order:

- ``requests``, ``responses``: framing, checksum, parsers
- ``link``: request and response; ``identification``: handshake, health check; ``scan_modes``
- ``measurement_nodes``, ``capsules``, ``hq_capsules``: decoders of packets
- ``timestamping``: time synchronisation of the samples with the host's clock
- ``revolutions``: scans from samples; ``scan_stream``: scans from bytes
- ``session``: baud-rate detection, one connection; ``driver``: RPLidar
"""

from slamlab.devices.rplidar.driver import RPLidar

__all__ = ["RPLidar"]
