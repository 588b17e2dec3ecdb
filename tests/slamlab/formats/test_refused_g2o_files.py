"""Pose-graph files without a planar graph are refused with line and remedy; saved ones are read."""

import gzip
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from slamlab.files import SourceError
from slamlab.posegraph import PoseGraph, g2o
from slamlab.posegraph.pose_graph import WORLD
from tests.slamlab.formats.graph_factors import GPS, PRIOR, RING, WITH_LANDMARKS, many, numbers
from tests.slamlab.formats.mutations import mutated

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
    "a short vertex": ("VERTEX_SE2 40 1 2", "line 5: VERTEX_SE2 needs 1 id and 3 numbers"),
    "an edge without matrix": (
        "EDGE_SE2 10 20 1 0 0",
        "line 5: EDGE_SE2 needs 2 ids and 9 numbers",
    ),
    "a line cut off": (EDGE[:-6], "line 5: EDGE_SE2 needs 2 ids .* 8 values, not 11"),
    "a number too many": (EDGE[:-1] + " 1", "line 5: EDGE_SE2 needs 2 ids .* 12 values, not 11"),
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
