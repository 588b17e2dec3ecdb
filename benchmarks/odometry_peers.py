"""Peers for lidar odometry (kiss-icp, small_gicp), if installed.

Both are designed for 3D lidars. For small_gicp, which needs normals, a planar scan is copied to
several heights; kiss-icp performs better without copies.
"""

import sys

import numpy as np

from benchmarks.icp_peers import matrix_of, planar, solid
from slamlab.geometry import between, compose

CARRIER = 0.5  # nearer returns are of who carries the lidar [m]
HEIGHTS = -0.1, 0.0, 0.1  # of the band [m]: walls get their normals in the plane
VOXEL, THRESHOLD = 0.1, (0.3, 0.03)  # of kiss-icp: first, and least motion; the best tried [m]
GRID = 0.05  # of the clouds of small_gicp [m]; finer is no better
KEYFRAME = 0.2, np.radians(15)  # to the next keyframe of the local map [m, rad]
KEYFRAMES = 20  # of the local map
PAIR_DISTANCE = 0.3  # of correspondences of small_gicp [m]
DESKEWINGS = 2  # of a scan, each by the motion found before


def peers():
    """Return {name: method(readings, source) -> poses (n, 3)} of installed peers; print the missing
    ones."""
    found = {}
    for package, methods in (("kiss_icp", kiss_icp), ("small_gicp", small_gicp)):
        try:
            found |= methods()
        except ImportError as error:
            name = package.replace("_icp", "-icp")
            print(f"skipped: {package}: {error}: python -m pip install {name}", file=sys.stderr)
    return found


def kiss_icp():
    """Return kiss-icp with its default rules; voxel size and initial threshold are adapted to
    rooms."""
    from kiss_icp.config import KISSConfig
    from kiss_icp.kiss_icp import KissICP

    def way(readings, source):
        config = KISSConfig(
            data={"max_range": source.sensor.range_max, "min_range": CARRIER},
            mapping={"voxel_size": VOXEL},
            registration={"max_num_threads": 1},
            adaptive_threshold={"initial_threshold": THRESHOLD[0], "min_motion_th": THRESHOLD[1]},
        )
        icp, poses = KissICP(config), []
        for reading in readings:
            points, times = _points(reading.scan)
            share = 1 + times / max(-reading.scan.times[0], 1e-9)
            icp.register_frame(solid(points), share)
            poses.append(planar(icp.last_pose))
        return np.array(poses)

    return {"kiss-icp": way}


def small_gicp():
    """Return small_gicp's point-to-plane ICP and GICP to a local map, with constant velocity."""
    import small_gicp as package

    def cloud(points):
        return package.preprocess_points(_band(points), downsampling_resolution=GRID)

    def method(kind):
        def way(readings, _source):
            poses, keyframes, before, velocity = [np.zeros(3)], [], None, np.zeros(3)
            for reading in readings:
                points, times = _points(reading.scan)
                if before is None:
                    keyframes.append((poses[0], points))
                    target, before = cloud(points), reading.time
                    continue
                period, before = reading.time - before, reading.time
                motion = period * velocity
                for _ in range(DESKEWINGS):
                    straight = _deskewed(points, times / period, motion)
                    result = package.align(
                        target[0],
                        cloud(straight)[0],
                        target[1],
                        matrix_of(compose(poses[-1], motion)),
                        registration_type=kind,
                        max_correspondence_distance=PAIR_DISTANCE,
                        max_iterations=50,
                    )
                    pose = planar(result.T_target_source)
                    motion = between(poses[-1], pose)
                velocity = motion / period
                poses.append(pose)
                gone = between(keyframes[-1][0], pose)
                if np.hypot(*gone[:2]) > KEYFRAME[0] or abs(gone[2]) > KEYFRAME[1]:
                    keyframes = [*keyframes[1 - KEYFRAMES :], (pose, straight)]
                    target = cloud(np.concatenate([_moved(p, at) for at, p in keyframes]))
            return np.array(poses)

        return way

    return {"small_gicp point to line": method("PLANE_ICP"), "small_gicp GICP": method("GICP")}


def _points(scan):
    """Return the points (k, 2) outside the carrier's radius, and their times (k,) before the scan's
    end [s]."""
    seen = scan.valid & (np.nan_to_num(scan.ranges) > CARRIER)
    r, a = scan.ranges[seen], scan.angles[seen]
    return np.column_stack([r * np.cos(a), r * np.sin(a)]), scan.times[seen]


def _band(points):
    return np.concatenate([np.column_stack([points, np.full(len(points), z)]) for z in HEIGHTS])


def _deskewed(points, shares, motion):
    """Deskew points to the scan's end; shares (k,) of the motion are from −1 to 0."""
    poses = between(motion, (1 + shares)[:, None] * motion)
    return compose(poses, np.column_stack([points, np.zeros(len(points))]))[:, :2]


def _moved(points, pose):
    return compose(pose, np.column_stack([points, np.zeros(len(points))]))[:, :2]
