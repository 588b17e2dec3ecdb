"""Pose-graph files of the world: read as their factors state."""

import gzip
import re
import warnings
from dataclasses import replace

import numpy as np
import pytest

from slamlab.geometry import between
from slamlab.posegraph import g2o
from tests.slamlab.formats.graph_factors import (
    GPS,
    POINTS,
    PRIOR,
    RING,
    RNG,
    TRUE,
    UNFIXED,
    WITH_LANDMARKS,
    many,
    measured,
    spread,
    text,
)
from tests.slamlab.support import public

ONE_GPS = replace(UNFIXED, priors=[(3, np.array([7.0, -2.0]), spread(RNG, 2))])
COMPASS = replace(
    UNFIXED,
    priors=[(k, np.array([0, 0, TRUE[k][2] + 0.02 * k]), np.diag([0, 0, 50.0])) for k in (1, 4)],
)
SURVEYED = replace(WITH_LANDMARKS, landmarks=WITH_LANDMARKS.landmarks | POINTS, fixed={10, 11})
ON_LANDMARKS = replace(
    WITH_LANDMARKS,
    fixed=set(),
    priors=[(k, POINTS[k] + 0.05, spread(RNG, 2)) for k in (10, 11, 12)],
)


def renamed(factors, names):
    """The same factors under other ids."""
    return replace(
        factors,
        poses={names(k): p for k, p in factors.poses.items()},
        edges=[(names(i), names(j), z, L) for i, j, z, L in factors.edges],
        fixed={names(k) for k in factors.fixed},
    )


TURN = np.array([0, 0, 2 * np.pi])
SYMBOLS = renamed(RING, lambda k: (ord("x") << 56) + k)
SCATTERED = renamed(RING, lambda k: [-7, 3, 12, 13, 500, 2**65][k])
NO_CHAIN = replace(RING, edges=[RING.edges[k] for k in (7, 6, 5, 3, 0)])
TURNED = replace(RING, edges=[(i, j, z + TURN, L) for i, j, z, L in RING.edges])
CHAIN_BACK = replace(RING, edges=[(j, i, measured(j, i), L) for i, j, _, L in RING.edges])
READ = {
    "g2o": (RING, many(RING)),
    "without FIX": (RING, many(UNFIXED)),
    "CRLF": (RING, many(RING).replace(b"\n", b"\r\n")),
    "UTF-16 of PowerShell": (RING, text(RING).encode("utf-16")),
    "gzip": (RING, gzip.compress(many(RING))),
    "tabs and blanks": (RING, many(RING).replace(b" ", b" \t ").replace(b"\n", b"  \n\n")),
    "comments": (RING, b"# made by hand\n" + many(RING).replace(b"\n", b" # caf\xe9 1 2\n")),
    "edges first": (RING, many(RING, order="efv")),
    "numbers with 6 digits": (RING, many(RING, number=lambda x: f"{x:.6f}")),
    "ids as savetxt writes them": (RING, many(RING, name=lambda k: f"{k:.18e}")),
    "ids of GTSAM's symbols": (SYMBOLS, many(SYMBOLS)),
    "negative and huge ids": (SCATTERED, many(SCATTERED)),
    "TORO": (RING, many(RING, toro=True)),
    "TORO of first release": (
        RING,
        many(RING, toro=True).replace(b"VERTEX2", b"VERTEX").replace(b"EDGE2", b"EDGE"),
    ),
    "TORO and g2o mixed": (
        RING,
        text(replace(RING, edges=RING.edges[:4]), toro=True).encode()
        + many(replace(RING, edges=RING.edges[4:]), order="e"),
    ),
    "edges alone": (RING, many(RING, vertices=False)),
    "edges alone, backwards": (CHAIN_BACK, many(CHAIN_BACK, vertices=False)),
    "edges alone, no chain": (NO_CHAIN, many(NO_CHAIN, vertices=False)),
    "turns of more than half a turn": (RING, many(TURNED)),
    "one FIX for both": (replace(RING, fixed={0, 4}), many(UNFIXED) + b"FIX 0 4\n"),
    "landmarks": (WITH_LANDMARKS, many(WITH_LANDMARKS)),
    "landmarks without vertices": (WITH_LANDMARKS, many(WITH_LANDMARKS, vertices=False)),
    "landmarks, poses with vertices": (
        WITH_LANDMARKS,
        re.sub(rb"VERTEX_XY.*\n", b"", many(WITH_LANDMARKS)),
    ),
    "surveyed landmarks": (SURVEYED, many(SURVEYED)),
    "priors on landmarks": (ON_LANDMARKS, many(ON_LANDMARKS)),
    "a prior": (PRIOR, many(PRIOR)),
    "a prior, edges alone": (PRIOR, many(PRIOR, vertices=False)),
    "three positions (GPS)": (GPS, many(GPS)),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("kind", READ)
def test_a_graph_file_is_read_as_its_factors_state(tmp_path, kind):
    factors, content = READ[kind]
    (tmp_path / "graph.g2o").write_bytes(content)
    graph = g2o.load(tmp_path / "graph.g2o")
    truth, chi2 = factors.solution()
    optimum = graph.optimise()
    rough = "6 digits" in kind
    assert optimum.converged
    assert optimum.chi2 == pytest.approx(chi2, rel=1e-2 if rough else 1e-6, abs=1e-9)
    names = sorted([*factors.poses, *factors.landmarks])
    assert len(graph) == len(names)
    for row, name in zip(graph.poses, names, strict=True):
        assert (names.index(name) in graph.landmarks) == (name in factors.landmarks)
        np.testing.assert_allclose(row[:2], truth[name][:2], atol=1e-3 if rough else 1e-4)
        if name in factors.poses:
            assert np.cos(row[2] - truth[name][2]) > 1 - 1e-6


@pytest.mark.parametrize("factors", [ONE_GPS, COMPASS], ids=["one position", "headings alone"])
def test_directions_without_a_prior_are_fixed_at_no_cost(tmp_path, factors):
    (tmp_path / "graph").write_bytes(many(factors))
    graph = g2o.load(tmp_path / "graph")
    _, chi2 = factors.solution()
    optimum = graph.optimise()
    assert optimum.converged and not graph.fixed
    assert optimum.chi2 == pytest.approx(chi2, rel=1e-6, abs=1e-6)
    assert np.isfinite(graph.covariances()).all()
    if factors is ONE_GPS:
        np.testing.assert_allclose(graph.poses[3, :2], [7, -2], atol=1e-6)


def report(path):
    """A file's graph, and what its reading warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        graph = g2o.load(path)
    return graph, [str(one.message) for one in caught]


def test_a_common_file_is_read_without_a_warning(tmp_path):
    (tmp_path / "graph").write_bytes(many(WITH_LANDMARKS))
    assert report(tmp_path / "graph")[1] == []


def test_lines_that_constrain_nothing_are_left_out_and_counted(tmp_path):
    extra = b"PARAMS_SE2OFFSET 0 0 0 0\nPARAMS_SE2OFFSET 1 0 0 0\nROBOTLASER1 0 -1.5 3.1 0.01\n"
    (tmp_path / "graph").write_bytes(extra + many(RING))
    graph, (note,) = report(tmp_path / "graph")
    assert len(graph.edges) == len(RING.edges)
    assert note.endswith(
        "ignored lines without constraints: 2 of PARAMS_SE2OFFSET, 1 of ROBOTLASER1"
    )


def test_several_components_are_each_fixed_and_reported(tmp_path):
    other = replace(renamed(RING, lambda k: k + 100), fixed=set())
    (tmp_path / "graph").write_bytes(many(RING) + many(other) + b"VERTEX_SE2 70 1 2 3\n")
    graph, (note,) = report(tmp_path / "graph")
    assert "3 components" in note
    assert "6 from vertex 0, 1 from vertex 70, 6 from vertex 100" in note
    assert graph.fixed == {0, 6, 7}
    truth, chi2 = RING.solution()
    assert graph.optimise().chi2 == pytest.approx(2 * chi2, rel=1e-6)
    np.testing.assert_allclose(graph.poses[7:, :2], [truth[k][:2] for k in range(6)], atol=1e-4)


def test_angles_that_look_like_degrees_are_reported(tmp_path):
    degrees = [(i, j, z * [1, 1, 180 / np.pi], L) for i, j, z, L in RING.edges]
    (tmp_path / "graph").write_bytes(many(replace(RING, edges=degrees)))
    assert "degrees" in report(tmp_path / "graph")[1][0]


def test_robust_loops_follow_the_order_of_the_poses_among_landmarks(tmp_path):
    mixed = replace(RING, landmarks={1.5: np.zeros(2)}, observation_vectors=[])
    (tmp_path / "graph").write_bytes(
        many(mixed, name=lambda k: str(int(2 * k))) + b"EDGE_SE2_XY 2 3 1 0 1 0 1\n"
    )
    graph = g2o.load(tmp_path / "graph", robust_loops=True)
    assert graph.landmarks == {2}
    assert [edge.robust for edge in graph.edges] == [False] * 5 + [True] * 3 + [False]


@pytest.mark.parametrize("joined", [True, False])
def test_loops_that_may_be_false_do_not_bend_the_initial_poses(tmp_path, joined):
    steps = "".join(f"EDGE_SE2 {k} {k + 1} 1 0 0 1 0 0 1 0 1\n" for k in (0, 1, 2) if joined or k)
    loops = "EDGE_SE2 0 2 2 0 0 1 0 0 1 0 1\nEDGE_SE2 0 3 0 0 3 9 0 0 9 0 9\n"
    (tmp_path / "graph").write_text(steps + loops)
    x, y, _ = g2o.load(tmp_path / "graph", robust_loops=True).poses[3]
    assert bool(np.hypot(x - 3, y) < 1e-6) == joined  # else a loop is needed, and all are used


PUBLIC = {"intel": 45.00, "CSAIL": 40.55, "manhattan": 3549.04, "kitti_00": 98.32}


def test_poses_are_initialised_whatever_the_scale_of_the_information(tmp_path):
    path = tmp_path / "scales.g2o"
    rows = ((0, 1, "1 0 0.1", "1e-200"), (1, 2, "1 0 0.1", "1e300"), (2, 0, "-2 0 -0.2", "1"))
    path.write_text("".join(f"EDGE_SE2 {i} {j} {z} {w} 0 0 {w} 0 {w}\n" for i, j, z, w in rows))
    graph, _ = report(path)
    assert np.isfinite(graph.poses).all()
    np.testing.assert_allclose(between(*graph.poses[1:]), [1, 0, 0.1], atol=1e-3)  # the surest


@pytest.mark.parametrize("name", [*PUBLIC, pytest.param("city10000", marks=pytest.mark.slow)])
def test_public_graphs_reach_the_optimum_that_others_reach(name):
    graph, notes = report(public(f"{name}.g2o"))
    optimum = graph.optimise()
    assert notes == [] and optimum.converged
    assert optimum.chi2 == pytest.approx((PUBLIC | {"city10000": 511.99})[name], abs=0.01)
