"""Landmarks (features) from scans: lines of walls, corners, spikes.

Read in this order:

- ``spikes``; ``line_fitting``: line fits; ``ransac``, ``thesis_line_extraction``: line extraction
- ``sonar_lines``; ``corners``; ``wall_segments``; ``track_management``; ``downsampling``: voxels
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".line_fitting": ["Line", "fit", "total_least_squares"],
        ".ransac": ["Ransac", "lines"],
        ".track_management": ["TrackManager"],
    },
)
