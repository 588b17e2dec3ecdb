"""Text format of GTSAM's examples: its lines, and the message for each kind of bad line."""

import gzip

import numpy as np
import pytest

from slamlab.sources import SourceError, gtsam_text
from tests.slamlab.support import public

GOOD = """# a comment
ODOMETRY 0 1 0.5 -0.1 0.02 1e-4 1e-6 2e-6 4e-6 3e-7 9e-6

LANDMARK 1 2 4.5 -3.25 0.4 0.1 0.3  # a tree
"""


@pytest.mark.parametrize("packed", [False, True])
def test_both_kinds_of_lines_are_read_in_their_order(tmp_path, packed):
    path, content = tmp_path / "graph.txt", GOOD.encode()
    path.write_bytes(gzip.compress(content) if packed else content)
    odometry, landmark = gtsam_text.load(path)
    assert (odometry.i, odometry.j, odometry.of_landmark) == (0, 1, False)
    np.testing.assert_array_equal(odometry.z, [0.5, -0.1, 0.02])
    np.testing.assert_array_equal(
        odometry.covariance, [[1e-4, 1e-6, 2e-6], [1e-6, 4e-6, 3e-7], [2e-6, 3e-7, 9e-6]]
    )
    assert (landmark.i, landmark.j, landmark.of_landmark) == (1, 2, True)
    np.testing.assert_array_equal(landmark.covariance, [[0.4, 0.1], [0.1, 0.3]])


@pytest.mark.parametrize(
    ("bad", "expected"),
    [
        ("VERTEX2 0 0 0 0", "unknown keyword 'VERTEX2'"),
        ("LANDMARK 1 2 4.5 -3.25 0.4 0", "LANDMARK needs 7 numbers, not 6"),
        ("ODOMETRY 0 1 0.5 0 0 1 0 0 1 0", "ODOMETRY needs 11 numbers, not 10"),
        ("LANDMARK 1 2.5 4.5 -3.25 0.4 0 0.4", "invalid literal"),
        ("LANDMARK 1 2 here -3.25 0.4 0 0.4", "could not convert"),
        ("LANDMARK 1 2 nan -3.25 0.4 0 0.4", "must be finite"),
        ("LANDMARK 3 3 1 -3.25 0.4 0 0.4", "must differ"),
        ("LANDMARK 1 2 4.5 -3.25 0.4 0.5 0.4", "not positive definite"),
    ],
)
def test_a_bad_line_is_reported_with_its_number(tmp_path, bad, expected):
    path = tmp_path / "graph.txt"
    path.write_text(GOOD + bad)
    with pytest.raises(SourceError, match=rf"graph\.txt, line 5: .*{expected}"):
        gtsam_text.load(path)


def test_an_empty_and_a_truncated_file_are_refused(tmp_path):
    path = tmp_path / "graph.txt"
    path.write_text("# nothing\n")
    with pytest.raises(SourceError, match="contains no measurements"):
        gtsam_text.load(path)
    path.write_bytes(gzip.compress(GOOD.encode())[:-12])
    with pytest.raises(SourceError, match="truncated"):
        gtsam_text.load(path)


def test_victoria_park_has_its_poses_and_trees():
    measurements = gtsam_text.load(public("victoria-park"))
    trees = [each.j for each in measurements if each.of_landmark]
    assert (len(measurements) - len(trees), len(trees), len(set(trees))) == (6968, 3640, 151)
