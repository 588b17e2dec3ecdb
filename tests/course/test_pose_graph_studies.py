"""Studies of lesson 15: frames of edge covariances, odometry graphs, loop-closure candidates."""

import numpy as np
import pytest

from course.studies import edge_covariance_frames, false_loop_closures
from course.studies.odometry_graphs import odometry_graph, total_information
from slamlab import sources
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.runner import run
from slamlab.geometry import between
from slamlab.posegraph.edge_error import information
from slamlab.posegraph.optimisation import Optimum


@pytest.fixture(scope="module")
def corridor():
    return sources.open("sim:corridor", np.random.default_rng(0))


@pytest.fixture(scope="module")
def twins():
    return false_loop_closures.drive_twin_rooms()


def test_the_error_of_an_edge_has_the_turned_covariance_and_not_that_of_the_match(corridor):
    for degrees in (45, 90):
        by_z, by_e = edge_covariance_frames.matches(corridor.world, degrees, count=40).nees()
        assert 1.8 < by_e < 4.2
        assert by_z > 10 * by_e
    # after half a turn the wrong frame cannot be distinguished
    by_z, by_e = edge_covariance_frames.matches(corridor.world, 180, count=20).nees()
    assert by_z == pytest.approx(by_e, rel=0.3)


def test_a_chain_by_wheels_contradicts_nothing_and_a_larger_claim_widens_it(corridor):
    steps = np.tile([0.5, 0.02, 0.1], (6, 1))
    chain, wider = (odometry_graph(steps, corridor.robot, claim) for claim in (1.0, 2.0))
    np.testing.assert_allclose(between(chain.poses[:-1], chain.poses[1:]), steps, atol=1e-12)
    assert isinstance(found := chain.optimise(), Optimum)
    assert found.chi2 < 1e-12
    np.testing.assert_allclose(wider.covariances(), 4 * chain.covariances(), rtol=1e-6)


def test_the_information_of_all_poses_is_a_sum_over_edges_in_the_order_of_the_poses(corridor):
    graph = odometry_graph(np.tile([1.0, 0.0, 0.3], (4, 1)), corridor.robot)
    graph.add_edge(4, 0, np.zeros(3), information(np.zeros(3), np.eye(3)))
    found = total_information(graph)
    np.testing.assert_allclose(found, found.T, rtol=1e-9)
    held = np.linalg.inv(found[3:, 3:])
    blocks = [held[k : k + 3, k : k + 3] for k in range(0, 12, 3)]
    np.testing.assert_allclose(graph.covariances()[1:], blocks, rtol=1e-6)
    assert np.count_nonzero(np.linalg.eigvalsh(found) < 1e-9 * found.max()) == 3


@pytest.mark.slow
def test_no_gate_alone_lets_in_what_is_right_and_nothing_else(corridor):
    slam = run(corridor, GraphSlam(corridor.robot, loops=False)).estimator
    true = false_loop_closures.true_poses(slam, corridor)
    wrong, gates = false_loop_closures.verify_candidates(slam, true)
    for name in ("fits", "verified"):
        assert (gates[name] & wrong).sum() > (gates[name] & ~wrong).sum()
    assert gates["χ² gate"][~wrong].all()
    slides = gates["χ² gate"] & wrong
    assert slides.any(), "a match that slides claims too little to surprise"
    assert not (slides & gates["fits"]).any()
    everything = np.all(list(gates.values()), axis=0)
    assert not (everything & wrong).any()
    assert 0 < (everything & ~wrong).sum() < (~wrong).sum(), "every gate costs right loops"


@pytest.mark.slow
def test_a_gate_keeps_false_loops_out_and_without_it_they_ruin_a_map_that_trusts_them(twins):
    assert twins.count_false(twins.with_gate) == 0
    assert twins.count_false(twins.without) >= twins.false.sum() > 20
    assert twins.largest_error(twins.with_gate.graph.poses) < 0.2
    assert twins.largest_error(twins.without.graph.poses, twins.without) < 0.2
    trusted = false_loop_closures.trust_all(twins.without.graph)
    assert twins.largest_error(trusted.poses, twins.without) > 3


def test_false_loops_disagree_with_odometry_more_than_any_true_one(twins):
    surprises = twins.squared_mahalanobis()
    assert surprises[twins.false].min() > 5 * surprises[~twins.false].max()
    np.testing.assert_array_less(twins.squared_mahalanobis(2.0), surprises + 1e-9)


def test_what_is_offered_is_every_right_loop_and_as_many_false_ones_as_asked(twins):
    for count in (0, 1, 7):
        offered = twins.select_loops(count)
        assert twins.false[offered].sum() == count
        assert (~twins.false[offered]).sum() == (~twins.false).sum()
    assert len(twins.select_loops()) == len(twins.loops)
    assert false_loop_closures.ends(twins.with_gate.graph, []).shape == (0, 4)


@pytest.mark.parametrize("count", [1, 3, 10, None])
def test_the_map_of_the_twin_rooms_survives_false_loops(twins, count):
    loops = twins.select_loops(count)
    graph, optimum = twins.close_loops(loops)
    trusted, _ = twins.close_loops(loops, robust=False)
    assert twins.largest_error(graph.poses) < 0.35 < 4 < twins.largest_error(trusted.poses)
    assert not optimum.weights[-np.count_nonzero(twins.false[loops]) :].any()


@pytest.mark.slow
def test_no_single_false_loop_ruins_the_map_of_the_twin_rooms(twins):
    right = twins.select_loops(0)
    for one in np.flatnonzero(twins.false):
        graph, _ = twins.close_loops([*right, one])
        assert twins.largest_error(graph.poses) < 0.35


def test_the_first_phi_of_an_annealed_kernel_decides_about_the_map(twins):
    loops = twins.select_loops()
    errors = [twins.largest_error(twins.anneal(loops, start).poses) for start in (1e4, 1e8)]
    assert errors[0] < 0.5 < 3 < errors[1]


def test_odometry_with_errors_of_its_model_passes_a_gate_of_99_percent(twins):
    assert twins.share_rejected_by_model(11.3, runs=20) < 0.05
    assert np.mean(twins.squared_mahalanobis()[~twins.false] > 11.3) > 0.1
