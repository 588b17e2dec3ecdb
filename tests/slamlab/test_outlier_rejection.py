"""Robust kernels, and false loops that are rejected."""

from copy import deepcopy

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import chi2

from slamlab.geometry import between, compose
from slamlab.posegraph import PoseGraph, edge_error
from slamlab.posegraph.marginal_covariances import leave_one_out
from slamlab.posegraph.robust_kernels import DCS, PHI, Cauchy, Huber, Truncated
from tests.slamlab.square_tour import INFORMATION, SIDE, SIGMA, largest_deviation, square_tour


@pytest.mark.parametrize("kind", [Huber, Cauchy, DCS, Truncated])
@given(value=st.floats(0, 1e6), phi=st.floats(0.1, 100))
def test_the_weight_of_a_robust_kernel_is_the_derivative_of_its_cost(kind, value, phi):
    kernel, step = kind(phi), 1e-4 * max(1.0, value)
    slope = (kernel.cost(value + step) - kernel.cost(value)) / step
    assert kernel.weight(value + step) - 1e-6 <= slope <= kernel.weight(value) + 1e-6
    bound = {DCS: 3 * phi, Truncated: phi}.get(kind, np.inf)
    assert kernel.cost(value) <= bound


def test_the_usual_phi_keeps_99_percent_of_true_edges_whole():
    assert chi2(3).cdf(PHI) == pytest.approx(0.99, abs=1e-5)


@pytest.mark.parametrize("seed", range(5))
def test_true_robust_edges_are_kept_however_far_the_guesses_drifted(seed):
    graph, _ = square_tour(np.random.default_rng(seed), noise=0.5, drift=8.0, robust=True)
    trusting, _ = square_tour(np.random.default_rng(seed), noise=0.5, drift=8.0)
    optimum = graph.optimise()
    trusting.optimise()
    assert optimum.converged and optimum.weights.min() == 1
    assert largest_deviation(graph, graph.poses, trusting.poses) < 0.01


@pytest.mark.parametrize("seed", range(5))
def test_a_loop_that_drift_alone_makes_look_false_is_closed(seed):
    rng = np.random.default_rng(seed)
    graph, true = square_tour(rng, laps=1)
    del graph.edges[4 * SIDE - 1 :]
    last = between(true[-2], true[-1])
    graph.add_edge(4 * SIDE - 1, 4 * SIDE, last, INFORMATION)
    for edge in graph.edges:  # reckoned from what was measured: the drift is that of the edges
        graph.poses[edge.j] = compose(graph.poses[edge.i], edge.measured)
    seen = between(true[-1], true[0]) + 0.05 * SIGMA * rng.standard_normal(3)
    sharp = 400 * INFORMATION
    error = edge_error.error(graph.poses[-1], graph.poses[0], seen)
    assert error @ sharp @ error > 100 * PHI
    graph.add_edge(4 * SIDE, 0, seen, sharp, robust=True)
    assert graph.optimise().weights[-1] == 1
    error = edge_error.error(graph.poses[-1], graph.poses[0], seen)
    assert error @ sharp @ error < PHI


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("false", [1, 8])
def test_outlier_edges_are_rejected(seed, false):
    rng = np.random.default_rng(seed)
    graph, true = square_tour(rng, robust=True)
    without = deepcopy(graph)
    for _ in range(false):
        i = int(rng.integers(0, 4 * SIDE))
        j = int(rng.integers(i + 4, len(graph)))
        wrong = compose(between(true[i], true[j]), [*rng.choice([-2, 2], 2), 0.5])
        graph.add_edge(i, j, wrong, INFORMATION, robust=True)
    optimum, clean = graph.optimise(), without.optimise()
    assert not optimum.weights[-false:].any()
    # a true edge may be rejected, too, if that costs less
    assert optimum.chi2 < clean.chi2 + false * PHI + 1e-3
    assert graph.dropped == set(np.flatnonzero(optimum.weights == 0))


@pytest.mark.parametrize("seed", range(3))
def test_few_right_loops_far_apart_are_kept_beside_more_false_ones(seed):
    rng = np.random.default_rng(seed)
    graph, _ = square_tour(rng, laps=4, robust=True)
    loops = [edge for edge in graph.edges if edge.robust]
    graph.edges = [edge for edge in graph.edges if not edge.robust] + loops[::20]
    false = set(range(len(graph.edges), len(graph.edges) + 8))
    for _ in false:
        i = int(rng.integers(0, 3 * SIDE))
        j = int(rng.integers(i + 4, len(graph)))
        graph.add_edge(i, j, [*rng.choice([-20, 20], 2), 0.5], INFORMATION, robust=True)
    graph.optimise()
    assert graph.dropped == false


def test_leaving_an_edge_out_saves_what_its_leverage_predicts():
    graph, _ = square_tour(np.random.default_rng(3), noise=0.3)
    before = graph.optimise().chi2
    loops = [k for k, edge in enumerate(graph.edges) if edge.j < edge.i][::6]
    saved = leave_one_out(graph._problem(), graph.poses, np.array(loops))
    for k, less in zip(loops, saved, strict=True):
        without = deepcopy(graph)
        del without.edges[k]
        assert before - without.optimise().chi2 == pytest.approx(less, rel=0.02, abs=0.01)


def test_a_trusted_false_edge_bends_the_graph():
    graph, true = square_tour(np.random.default_rng(0))
    without = deepcopy(graph)
    without.optimise()
    graph.add_edge(3, 20, compose(between(true[3], true[20]), [2, 2, 0.5]), INFORMATION)
    graph.optimise()
    assert largest_deviation(without, graph.poses, without.poses) > 5


def ring_with_two_readings(right, false):
    """A long chain with ``right`` loops home, and ``false`` ones that agree on another place."""
    graph = PoseGraph()
    graph.add_pose(np.zeros(3))
    for k in range(40):
        graph.add_pose([0.5 * (k + 1), 0.0, 0.0])
        graph.add_edge(k, k + 1, [0.5, 0.0, 0.0], np.diag([50.0, 50.0, 400.0]))
    for k, place, side in [(k, 15.0, 0.4) for k in range(right)] + [
        (k, 16.5, -0.4) for k in range(false)
    ]:
        graph.add_edge(k, 30, [place - 0.5 * k, side, 0.0], 1e4 * np.eye(3), robust=True)
    return graph


def test_two_groups_of_loops_that_agree_equally_well_are_ambiguous_until_one_is_confirmed():
    even = ring_with_two_readings(5, 5)
    optimum = even.optimise()
    assert optimum.ambiguous
    assert len(even.dropped) == 5
    difference, distance = optimum.runner_up
    assert abs(difference) < 3 * PHI and distance > 0.1
    decided = ring_with_two_readings(12, 3)
    assert not decided.optimise().ambiguous
    assert decided.dropped == set(range(len(decided.edges) - 3, len(decided.edges)))


def test_a_loop_that_later_ones_contradict_is_let_go():
    graph = ring_with_two_readings(0, 2)
    assert graph.optimise() and not graph.dropped
    false = set(range(len(graph.edges) - 2, len(graph.edges)))
    for edge in ring_with_two_readings(8, 0).edges[-8:]:
        graph.add_edge(*edge)
    graph.optimise()
    assert graph.dropped >= false
