"""The studies of lesson 15: in which frame an edge errs, graphs by wheels, loops on trial."""

import numpy as np
import pytest

from slamlab import sources
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.runner import run
from slamlab.geometry import between
from slamlab.posegraph.edge_error import information
from slamlab.posegraph.optimisation import Optimum
from slamlab.studies import edge_frames, false_loops
from slamlab.studies.wheel_graphs import information_of_all, wheels_graph


@pytest.fixture(scope="module")
def corridor():
    return sources.open("sim:corridor", np.random.default_rng(0))


@pytest.fixture(scope="module")
def twins():
    return false_loops.twins()


@pytest.mark.parametrize("degrees", [45, 90])
def test_the_error_of_an_edge_has_the_turned_covariance_and_not_that_of_the_match(
    corridor, degrees
):
    by_z, by_e = edge_frames.matches(corridor.world, degrees, count=40).nees()
    assert 1.8 < by_e < 4.2
    assert by_z > 10 * by_e


def test_after_half_a_turn_the_wrong_frame_cannot_be_told(corridor):
    by_z, by_e = edge_frames.matches(corridor.world, 180, count=20).nees()
    assert by_z == pytest.approx(by_e, rel=0.3)


def test_a_chain_by_wheels_contradicts_nothing_and_a_larger_claim_widens_it(corridor):
    steps = np.tile([0.5, 0.02, 0.1], (6, 1))
    chain, wider = (wheels_graph(steps, corridor.robot, claim) for claim in (1.0, 2.0))
    np.testing.assert_allclose(between(chain.poses[:-1], chain.poses[1:]), steps, atol=1e-12)
    assert isinstance(found := chain.optimise(), Optimum)
    assert found.chi2 < 1e-12
    np.testing.assert_allclose(wider.covariances(), 4 * chain.covariances(), rtol=1e-6)


def test_the_information_of_all_poses_is_a_sum_over_edges_in_the_order_of_the_poses(corridor):
    graph = wheels_graph(np.tile([1.0, 0.0, 0.3], (4, 1)), corridor.robot)
    graph.add_edge(4, 0, np.zeros(3), information(np.zeros(3), np.eye(3)))
    found = information_of_all(graph)
    np.testing.assert_allclose(found, found.T, rtol=1e-9)
    held = np.linalg.inv(found[3:, 3:])
    blocks = [held[k : k + 3, k : k + 3] for k in range(0, 12, 3)]
    np.testing.assert_allclose(graph.covariances()[1:], blocks, rtol=1e-6)
    assert np.count_nonzero(np.linalg.eigvalsh(found) < 1e-9 * found.max()) == 3


@pytest.mark.slow
def test_no_gate_alone_lets_in_what_is_right_and_nothing_else(corridor):
    slam = run(corridor, GraphSlam(corridor.robot, loops=False)).estimator
    wrong, gates = false_loops.judged(slam, false_loops.true_poses(slam, corridor))
    for name in ("fits", "verified"):
        assert (gates[name] & wrong).sum() > (gates[name] & ~wrong).sum()
    assert gates["no surprise"][~wrong].all()
    slides = gates["no surprise"] & wrong
    assert slides.any(), "a match that slides claims too little to surprise"
    assert not (slides & gates["fits"]).any()
    everything = np.all(list(gates.values()), axis=0)
    assert not (everything & wrong).any()
    assert 0 < (everything & ~wrong).sum() < (~wrong).sum(), "every gate costs right loops"


@pytest.mark.slow
def test_a_gate_keeps_false_loops_out_and_without_it_they_ruin_the_map(twins):
    assert twins.false_in(twins.with_gate) == 0
    assert twins.false_in(twins.without) >= twins.false.sum() > 20
    assert twins.worst(twins.with_gate.graph.poses) < 0.2
    assert twins.worst(twins.without.graph.poses, twins.without) > 3


def test_false_loops_surprise_the_wheels_more_than_any_right_one(twins):
    surprises = twins.surprises()
    assert surprises[twins.false].min() > 5 * surprises[~twins.false].max()
    np.testing.assert_array_less(twins.surprises(2.0), surprises + 1e-9)


def test_one_liar_is_weighed_down_and_five_end_in_a_dearer_map(twins):
    one, trusted = (twins.closed(twins.offered(1), phi)[0] for phi in (11.3, np.inf))
    assert twins.worst(one.poses) < 0.5 < twins.worst(trusted.poses)
    graph, optimum = twins.closed(twins.offered(5), 11.3)
    assert twins.worst(graph.poses) > 3
    broken = false_loops.cost(graph, 11.3)
    assert broken == pytest.approx(optimum.chi2)
    graph.poses = twins.closed(twins.offered(0), 11.3)[0].poses
    assert false_loops.cost(graph, 11.3) < 0.2 * broken


def test_what_is_offered_is_every_right_loop_and_as_many_false_ones_as_asked(twins):
    for count in (0, 1, 7):
        offered = twins.offered(count)
        assert twins.false[offered].sum() == count
        assert (~twins.false[offered]).sum() == (~twins.false).sum()
    assert len(twins.offered()) == len(twins.loops)
    assert false_loops.ends(twins.with_gate.graph, []).shape == (0, 4)


def test_robust_weights_withstand_two_false_loops_of_the_twins_and_not_three(twins):
    """What lesson 15 says beside its table of false loops."""

    def off_by(count, phi):
        return twins.worst(twins.closed(twins.offered(count), phi)[0].poses)

    whole = off_by(0, 11.3)
    assert off_by(1, np.inf) > 4
    assert max(off_by(1, 11.3), off_by(2, 11.3)) < whole + 0.05
    assert off_by(2, 300) > 4 and off_by(2, 1) > 2 * whole
    assert min(off_by(3, 11.3), off_by(5, 11.3)) > 6
