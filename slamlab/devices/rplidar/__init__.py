"""RPLIDAR driver and protocol of Slamtec's laser scanner; ``RPLidar`` gives whole revolutions.

Read in this order:

- ``requests``, ``responses``; ``request_parser`` and ``response_finder`` find them in a stream
- ``link``: ask and answer; ``identification``: the handshake; ``scan_modes``: which there are
- ``measurement_nodes``, ``capsules``: decoders; ``timestamping``: when each point was measured
- ``revolutions``: points to whole scans; ``scan_stream``: bytes to scans
- ``session``: one connection; ``driver``: RPLidar
"""

from slamlab.devices.rplidar.driver import RPLidar

__all__ = ["RPLidar"]
