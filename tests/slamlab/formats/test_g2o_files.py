"""Pose-graph files of the world: read as their factors state, or refused with line and remedy.

The truth is a dense least-squares solution of the same factors, written here apart from slamlab's.
"""

import gzip
import re
import warnings
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.optimize import least_squares

from slamlab.files import SourceError
from slamlab.geometry import between
from slamlab.posegraph import PoseGraph, g2o
from slamlab.posegraph.pose_graph import WORLD
from slamlab.sources.public_datasets import recording
from tests.slamlab.formats.mutations import mutated

ORDER = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]  # of g2o's information entries
TORO_ORDER = [(0, 0), (0, 1), (1, 1), (2, 2), (0, 2), (1, 2)]


@dataclass
class Factors:
    """A small planar graph: guesses of nodes by id, and measurements as (ids…, z, information)."""

    poses: dict = field(default_factory=dict)
    landmarks: dict = field(default_factory=dict)
    edges: list = field(default_factory=list)
    observation_vectors: list = field(default_factory=list)
    priors: list = field(default_factory=list)
    fixed: set = field(default_factory=set)

    def solution(self):
        """Poses and landmarks of least squares by id, the optimal χ²; heading kept in [−π, π]."""
        free = [name for name in (*self.poses, *self.landmarks) if name not in self.fixed]
        given = self.poses | self.landmarks
        sizes = [len(given[name]) for name in free]

        def unpack(x):
            return given | dict(zip(free, np.split(x, np.cumsum(sizes)[:-1]), strict=True))

        def residuals(x):
            at, out = unpack(x), []
            for i, j, z, L in self.edges:
                out.append(np.linalg.cholesky(L).T @ seen(seen(at[i], at[j]), z, back=True))
            for i, j, z, L in self.observation_vectors:
                out.append(np.linalg.cholesky(L).T @ (seen(at[i], [*at[j], 0])[:2] - z))
            for i, z, L in self.priors:
                whole = len(z) == 3
                e = seen(at[i], z, back=True) if whole else np.array(at[i][:2]) - z
                out.append(psd_root(L) @ e)
            return np.concatenate(out)

        start = np.concatenate([np.array(given[name], float) for name in free])
        best = least_squares(residuals, start, method="trf", xtol=1e-14, ftol=1e-14, gtol=1e-14)
        return unpack(best.x), 2 * best.cost


def seen(a, b, back=False):
    """Pose b as seen from a; with back a as seen from b."""
    a, b = (b, a) if back else (a, b)
    c, s = np.cos(a[2]), np.sin(a[2])
    dx, dy, turn = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    turn = np.arctan2(np.sin(turn), np.cos(turn))
    return np.array([c * dx + s * dy, c * dy - s * dx, turn])


def psd_root(information):
    values, vectors = np.linalg.eigh(information)
    return (vectors * np.sqrt(np.maximum(values, 0))).T


def spread(rng, size):
    """A full information matrix."""
    mixed = np.eye(size) + rng.uniform(-0.5, 0.5, (size, size))
    return mixed @ np.diag(rng.uniform(5, 200, size)) @ mixed.T


RNG = np.random.default_rng(5)
TRUE = {k: np.array([2 * k % 7, 0.3 * k * k, 0.8 * k - 2]) for k in range(6)}
TRUE[0] = np.zeros(3)
POINTS = {10: np.array([1.0, 4.0]), 11: np.array([5.0, -1.0]), 12: np.array([3.0, 6.0])}


def measured(i, j):
    return seen(TRUE[i], TRUE[j]) + RNG.normal(0, [0.1, 0.1, 0.05])


RING = Factors(
    poses={k: pose + (k > 0) * RNG.normal(0, 0.1, 3) for k, pose in TRUE.items()},
    edges=[
        (i, j, measured(i, j), spread(RNG, 3))
        for i, j in [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0), (4, 1), (2, 5)]
    ],
    fixed={0},
)
WITH_LANDMARKS = replace(
    RING,
    landmarks={name: place + RNG.normal(0, 0.1, 2) for name, place in POINTS.items()},
    observation_vectors=[
        (i, j, seen(TRUE[i], [*POINTS[j], 0])[:2] + RNG.normal(0, 0.1, 2), spread(RNG, 2))
        for i, j in [(0, 10), (1, 10), (2, 11), (3, 11), (4, 12), (5, 12), (0, 12), (5, 10)]
    ],
)
UNFIXED = replace(RING, fixed=set())
PRIOR = replace(UNFIXED, priors=[(2, np.array([3.0, 1.0, 0.4]), spread(RNG, 3))])
GPS = replace(
    UNFIXED, priors=[(k, TRUE[k][:2] + RNG.normal(0, 0.1, 2), spread(RNG, 2)) for k in (0, 2, 5)]
)
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


def text(factors, vertices=True, toro=False, name=str, number=repr, order="vfe"):
    """The lines of a file, its numbers as ``number`` writes them, ids as ``name``."""

    def row(word, ids, numbers):
        return " ".join([word, *map(name, ids), *(number(float(n)) for n in numbers)])

    def entries(information):
        order = (TORO_ORDER if toro else ORDER) if len(information) == 3 else ORDER[:2] + ORDER[3:4]
        return [information[cell] for cell in order]

    pose, edge = ("VERTEX2", "EDGE2") if toro else ("VERTEX_SE2", "EDGE_SE2")
    parts = {
        "v": [row(pose, [k], p) for k, p in factors.poses.items()]
        + [row("VERTEX_XY", [k], p) for k, p in factors.landmarks.items()],
        "f": [row("FIX", [k], []) for k in sorted(factors.fixed)],
        "e": [row(edge, (i, j), [*z, *entries(L)]) for i, j, z, L in factors.edges]
        + [
            row("EDGE_SE2_XY", (i, j), [*z, *entries(L)])
            for i, j, z, L in factors.observation_vectors
        ],
    }
    for i, z, L in factors.priors:
        word = "EDGE_PRIOR_SE2" if len(z) == 3 else "EDGE_PRIOR_SE2_XY"
        word = "EDGE_PRIOR_XY" if i in factors.landmarks else word
        parts["e"].append(row(word, [i], [*z, *entries(L)]))
    rows = [line for part in order if vertices or part != "v" for line in parts[part]]
    return "".join(line + "\n" for line in rows)


def many(factors, **options):
    return text(factors, **options).encode()


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


HEAD = "VERTEX_SE2 10 0 0 0\nVERTEX_SE2 20 1 0 0\nVERTEX_XY 30 5 5\n"  # three lines
EDGE = "EDGE_SE2 10 20 1 0 0 1 0 0 1 0 1\n"  # the fourth
REFUSED = {
    "3-D vertex": ("VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1", r"line 5: VERTEX_SE3:QUAT .*3-D"),
    "3-D edge of TORO": ("EDGE3 0 1 0 0 0 0 0 0", "line 5: EDGE3 .* write x, y and yaw"),
    "unknown word": ("VERTEX_SE 1 0 0 0", "line 5: VERTEX_SE is not a keyword .* VERTEX_SE2"),
    "iSAM's odometry": ("ODOMETRY 0 1 1 0 0 1 0 0 1 0 1", "line 5: ODOMETRY .* write EDGE_SE2"),
    "range and bearing": ("BR 10 30 0.1 4 0.1 0.1", "line 5: BR .* as EDGE_SE2_XY"),
    "equivalence": ("EQUIV 10 20", "line 5: EQUIV .* same id"),
    "commas for blanks": ("EDGE_SE2,10,20,1,0,0,1,0,0,1,0,1", "line 5: EDGE_SE2,10.* is no"),
    "decimal commas": ("EDGE_SE2 10 20 1,5 0 0 1 0 0 1 0 1", "line 5: '1,5' .* decimal point"),
    "a short vertex": ("VERTEX_SE2 40 1 2", "line 5: VERTEX_SE2 has 1 id and 3 numbers"),
    "an edge without matrix": ("EDGE_SE2 10 20 1 0 0", "line 5: EDGE_SE2 has 2 ids and 9 numbers"),
    "a line cut off": (EDGE[:-6], "line 5: EDGE_SE2 has 2 ids .* 8 of 11"),
    "a number too many": (EDGE[:-1] + " 1", "line 5: EDGE_SE2 has 2 ids .* 12 of 11"),
    "duplicate vertex": ("VERTEX_SE2 20 1 2 3", "line 5: duplicate vertex 20"),
    "missing vertex": (EDGE.replace("20", "50"), "line 5: there is no vertex 50; add it"),
    "FIX of a missing one": ("FIX 20 50", "line 5: there is no vertex 50"),
    "FIX of a word": ("FIX first", "line 5: 'first' is not a number"),
    "half an id": (EDGE.replace("20", "20.5"), "line 5: an id must be an integer, not 20.5"),
    "an id that is rounded": ("VERTEX_SE2 1e20 0 0 0", "line 5: an id must be an integer"),
    "an edge to itself": (EDGE.replace("20", "10"), "line 5: EDGE_SE2 connects vertex 10 to"),
    "an edge to a landmark": (EDGE.replace("20", "30"), "line 5: vertex 30 is a landmark"),
    "a landmark that is a pose": ("EDGE_SE2_XY 10 20 1 0 1 0 1", "line 5: vertex 20 is a pose"),
    "singular information": (EDGE.replace("1 0 1\n", "1 0 0"), "line 5: .* singular or negative"),
    "row by row under TORO's name": ("EDGE2 10 20 1 0 0 2 0 0 3 0 4", "line 5: EDGE2.*EDGE_SE2$"),
    "TORO's order under g2o's name": ("EDGE_SE2 10 20 1 0 0 2 0 3 4 0 0", "line 5: .* singular"),
    "not a number": (EDGE.replace("1 0 0 1", "nan 0 0 1"), "line 5: nan is not finite"),
    "underscores": (EDGE.replace("20", "2_0"), "line 5: '2_0' is not a number"),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_a_graph_that_is_not_planar_is_refused_with_its_line_and_a_remedy(tmp_path, kind):
    line, message = REFUSED[kind]
    (tmp_path / "graph").write_text(HEAD + EDGE + line + "\n", encoding="utf-8")
    with pytest.raises(SourceError, match=message) as refused:
        g2o.load(tmp_path / "graph")
    assert len(str(refused.value).splitlines()) == 1
    assert str(refused.value).startswith(str(tmp_path))


WHOLE_FILES = {
    "empty": (b"", "contains no pose graph"),
    "FIX alone": (b"FIX 0\n", "contains no pose graph"),
    "torn gzip": (gzip.compress(many(RING))[:-60], r"truncated.* in line \d+"),
    "landmarks' vertices alone": (
        re.sub(rb"VERTEX_SE2.*\n", b"", many(WITH_LANDMARKS)),
        "VERTEX_XY, but no VERTEX_SE2",
    ),
    "poses tied by landmarks alone": (
        many(replace(WITH_LANDMARKS, edges=WITH_LANDMARKS.edges[:3]), vertices=False),
        "only landmarks connect",
    ),
    "two fixed without vertices": (
        many(replace(RING, fixed={0, 4}), vertices=False),
        r"line 2: FIX needs a pose",
    ),
}


@pytest.mark.parametrize("kind", WHOLE_FILES)
def test_a_file_that_holds_no_whole_graph_is_refused(tmp_path, kind):
    content, message = WHOLE_FILES[kind]
    (tmp_path / "graph").write_bytes(content)
    with pytest.raises(SourceError, match=message):
        g2o.load(tmp_path / "graph")


def test_a_file_that_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(SourceError, match="cannot be written"):
        g2o.save(PoseGraph(), tmp_path)


numbers = st.floats(-1e6, 1e6)


@st.composite
def graphs(draw):
    """Graphs of poses, landmarks, all kinds of edges; every component fixed."""
    graph = PoseGraph()
    for _ in range(draw(st.integers(1, 6))):
        if len(graph) and draw(st.booleans()):
            graph.add_landmark([draw(numbers), draw(numbers)])
        else:
            graph.add_pose([draw(numbers) for _ in range(3)])
    poses = [k for k in range(len(graph)) if k not in graph.landmarks]
    graph.fixed = {0} | draw(st.sets(st.integers(0, len(graph) - 1)))
    for _ in range(draw(st.integers(0, 8))):
        i = draw(st.sampled_from([WORLD, *poses]))
        j = draw(st.integers(0, len(graph) - 1))
        size = 2 if j in graph.landmarks or (i == WORLD and draw(st.booleans())) else 3
        z = [draw(numbers) for _ in range(size)]
        root = np.array([[draw(st.floats(-3, 3)) for _ in range(size)] for _ in range(size)])
        information = root @ root.T + np.diag([draw(st.floats(0.1, 1e6)) for _ in range(size)])
        information = (information + information.T) / 2
        if i == WORLD:
            graph.add_prior(j, z, information)
        elif i != j:
            graph.add_edge(i, j, z, information)
    for k in range(1, len(graph)):  # every node is tied to the first
        if k in graph.landmarks:
            graph.add_edge(0, k, [1, 2], np.eye(2))
        else:
            graph.add_edge(0, k, [1, 2, 3], np.eye(3))
    return graph


@pytest.mark.filterwarnings("ignore")
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(graphs())
def test_saving_and_loading_bring_back_the_same_graph(tmp_path, graph):
    g2o.save(graph, tmp_path / "graph.g2o")
    before = (tmp_path / "graph.g2o").read_bytes()
    again = g2o.load(tmp_path / "graph.g2o")
    assert (again.fixed, again.landmarks) == (graph.fixed, graph.landmarks)
    np.testing.assert_array_equal(again.poses, graph.poses)
    for a, b in zip(again.edges, graph.edges, strict=True):
        assert a[:2] == b[:2]
        np.testing.assert_array_equal(a.measured, b.measured)
        np.testing.assert_array_equal(a.information, b.information)
    g2o.save(again, tmp_path / "graph.g2o")
    assert (tmp_path / "graph.g2o").read_bytes() == before


WORDS = [*many(WITH_LANDMARKS).split()[:40], *b"VERTEX_SE2 FIX EDGE2 nan 1e400 \xff".split()]


@pytest.mark.filterwarnings("ignore")
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=150)
@given(
    st.sampled_from(
        [many(WITH_LANDMARKS), many(PRIOR, toro=True), gzip.compress(many(GPS))]
    ).flatmap(lambda content: mutated(content, WORDS))
)
def test_a_mutated_file_is_read_or_refused_and_raises_nothing_else(tmp_path, content):
    (tmp_path / "graph").write_bytes(content)
    try:
        graph = g2o.load(tmp_path / "graph")
    except SourceError as refused:
        assert len(str(refused)) < 600
    else:
        assert np.isfinite(graph.poses).all()


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
    try:
        path = recording(f"{name}.g2o")
    except SourceError as missing:
        pytest.skip(str(missing))
    graph, notes = report(path)
    optimum = graph.optimise()
    assert notes == [] and optimum.converged
    assert optimum.chi2 == pytest.approx((PUBLIC | {"city10000": 511.99})[name], abs=0.01)
