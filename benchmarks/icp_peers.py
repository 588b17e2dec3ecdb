"""Peer scan matchers (small_gicp, Open3D), if installed, with their best settings for planar
scans."""

import sys

import numpy as np

from benchmarks.common import Missing
from slamlab.geometry import from_matrix
from slamlab.scanmatching import normals

MAX_PAIR_DISTANCE = 1.0  # correspondence distance [m]; less narrows their basins
MAX_ITERATIONS = 100  # of ICP


def sklearn_neighbours():
    """Import scikit-learn's NearestNeighbors, which the thesis' ICP needs."""
    try:
        from sklearn.neighbors import NearestNeighbors
    except ImportError:
        raise Missing(
            "scikit-learn, the peer, is not installed: python -m pip install scikit-learn"
        ) from None
    return NearestNeighbors


def peers():
    """Return {name: method(source, target, guess) -> pose} of installed peers; print the missing
    ones to stderr."""
    found = {}
    for package, methods in (("small_gicp", small_gicp), ("open3d", open3d)):
        try:
            found |= methods()
        except ImportError as error:
            print(f"skipped: {package}: {error}: python -m pip install {package}", file=sys.stderr)
    return found


def small_gicp():
    """Return small_gicp's ICP and GICP, without point-to-line ICP, because its normals need a third
    dimension."""
    import small_gicp as package

    def method(kind):
        def matched(source, target, guess):
            result = package.align(
                solid(target),
                solid(source),
                matrix_of(guess),
                registration_type=kind,
                max_correspondence_distance=MAX_PAIR_DISTANCE,
                downsampling_resolution=1e-3,
                num_threads=1,
                max_iterations=MAX_ITERATIONS,
            )
            return planar(result.T_target_source)

        return matched

    return {"small_gicp ICP": method("ICP"), "small_gicp GICP": method("GICP")}


def open3d():
    """Return Open3D's point-to-point ICP and, with our normals, point-to-line ICP."""
    from open3d import geometry, utility
    from open3d.pipelines import registration

    def cloud(points, with_normals=False):
        made = geometry.PointCloud(utility.Vector3dVector(solid(points)))
        if with_normals:
            known = np.nan_to_num(normals(points), nan=0.0)
            made.normals = utility.Vector3dVector(solid(known))
        return made

    def method(estimation, with_normals):
        def matched(source, target, guess):
            result = registration.registration_icp(
                cloud(source),
                cloud(target, with_normals),
                MAX_PAIR_DISTANCE,
                matrix_of(guess),
                estimation,
                registration.ICPConvergenceCriteria(max_iteration=MAX_ITERATIONS),
            )
            return planar(result.transformation)

        return matched

    kinds = registration
    return {
        "Open3D point to point": method(kinds.TransformationEstimationPointToPoint(), False),
        "Open3D point to line": method(kinds.TransformationEstimationPointToPlane(), True),
    }


def solid(points):
    """Return the points (n, 3) in the plane z = 0."""
    return np.column_stack([points, np.zeros(len(points))])


def matrix_of(pose):
    """Return a pose as a homogeneous matrix (4, 4)."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    T = np.eye(4)
    T[:2, :2], T[:2, 3] = [[c, -s], [s, c]], pose[:2]
    return T


def planar(T):
    """Return the pose (3,) of a homogeneous matrix (4, 4)."""
    return from_matrix(T[np.ix_([0, 1, 3], [0, 1, 3])])
