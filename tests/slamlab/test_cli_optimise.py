"""``slamlab optimise``: pose graphs in files."""

import io
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from slamlab.cli import main, optimise
from slamlab.geometry import between, compose
from slamlab.posegraph import g2o
from slamlab.posegraph.pose_graph import PoseGraph

INFORMATION = np.diag([400.0, 400.0, 2500.0])


def ring(rng, count=24, false=0):
    """A graph of a robot that drives two laps, and some loops that are false."""
    truth = [np.zeros(3)]
    for _ in range(2 * count - 1):
        truth.append(compose(truth[-1], np.array([1.0, 0.0, 2 * np.pi / count])))
    truth, graph = np.array(truth), PoseGraph(truth)
    pairs = [(k, k + 1) for k in range(2 * count - 1)] + [(k, k + count) for k in range(count)]
    for i, j in pairs:
        noise = rng.multivariate_normal(np.zeros(3), np.linalg.inv(INFORMATION))
        graph.add_edge(i, j, compose(between(truth[i], truth[j]), noise), INFORMATION)
    for k in range(false):
        graph.add_edge(k, k + count // 2, np.array([0.3, 0.1 * k, 1.0]), INFORMATION)
    return graph


@pytest.fixture
def written(tmp_path):
    """Write a ring to a file and return its path."""

    def write(**how):
        g2o.save(ring(np.random.default_rng(1), **how), tmp_path / "ring.g2o")
        return str(tmp_path / "ring.g2o")

    return write


def test_the_optimum_its_covariances_and_a_picture_are_written(tmp_path, written, capsys):
    out, table, picture = (str(tmp_path / name) for name in ("out.g2o", "P.csv", "graph.png"))
    options = ["--out", out, "--covariances", table, "--picture", picture]
    assert main(["optimise", written(), *options]) == 0
    printed = capsys.readouterr().out
    graph = ring(np.random.default_rng(1))
    chi2 = graph.optimise().chi2
    assert f"χ² after optimisation: {chi2:.6g} (converged" in printed
    np.testing.assert_allclose(g2o.load(out).poses, graph.poses, atol=1e-5)
    rows = np.loadtxt(table, delimiter=",", skiprows=1)
    np.testing.assert_allclose(rows[:, 1], graph.covariances()[:, 0, 0], rtol=1e-3)
    assert Image.open(picture).size > (400, 200)


def test_false_loops_are_rejected_named_and_left_out_of_the_new_file(tmp_path, written, capsys):
    out = str(tmp_path / "out.g2o")
    assert main(["optimise", written(false=2), "--robust", "--out", out]) == 0
    assert "rejected loops (2): 0-12, 1-13\n" in capsys.readouterr().out
    clean = ring(np.random.default_rng(1))
    clean.optimise()
    assert len(g2o.load(out).edges) == len(clean.edges)
    np.testing.assert_allclose(g2o.load(out).poses, clean.poses, atol=1e-3)
    assert main(["optimise", out, "--robust"]) == 0
    assert "rejected loops (0): none\n" in capsys.readouterr().out


def test_a_graph_is_read_from_stdin_and_refused_by_this_name(monkeypatch, written, capsys):
    for text, code in ((Path(written()).read_bytes(), 0), (b"EDGE_SE2 0 1 x", 2)):
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text)))
        assert main(["optimise", "-"]) == code
    assert capsys.readouterr().err.startswith("slamlab optimise: stdin, line 1")


def test_a_file_that_cannot_be_written_is_named_in_one_line(tmp_path, written, capsys):
    for option in ("--out", "--covariances", "--picture"):
        assert main(["optimise", written(), option, str(tmp_path / "no" / "file")]) == 2
        error = capsys.readouterr().err
        assert error.count("\n") == 1 and str(tmp_path / "no") in error


def test_a_picture_shows_landmarks_apart_from_the_trajectory():
    graph = ring(np.random.default_rng(1))
    landmark = graph.add_landmark([30.0, 30.0])
    graph.add_edge(5, landmark, [29.0, 30.0], np.eye(2))
    fig = optimise._picture(graph, graph.poses, [])
    assert "landmarks" in [text.get_text() for text in fig.legends[0].texts]
    for ax in fig.axes:  # a trajectory through the landmark would end there
        assert max(line.get_xdata().max() for line in ax.lines if len(line.get_xdata()) > 2) < 10
