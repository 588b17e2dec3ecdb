"""Landmarks from scans: walls' lines by RANSAC, corners, spikes; tentative and confirmed ones.

Read in this order:

- ``spikes``: narrow things before a background
- ``line_fitting``: a line through noisy points; ``ransac``: lines in a scan;
  ``sampled_lines``: the same as Smolec lists it
- ``sonar_lines``: lines in a scan of wide beams, by the cone model
- ``corners``: where two walls meet; ``wall_segments``: a line split at gaps
- ``tentative_walls``: tentative landmarks until they are confirmed
- ``downsampling``: points downsampled for drawing
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".line_fitting": ["Line", "fit", "total_least_squares"],
        ".ransac": ["Ransac", "lines"],
        ".tentative_walls": ["TentativeWalls"],
    },
)
