"""Options of estimators: each takes its own and refuses the others', by name and with a reason."""

import json

import numpy as np

from slamlab import estimators, sources
from slamlab.cli import main
from slamlab.estimators.corner_association import ASSOCIATORS
from slamlab.estimators.options import OPTIONS, TAKES, checked
from slamlab.estimators.set_membership_slam import BOUNDS
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from tests.slamlab.support import refuses


def brief():
    return LandmarkRun(Loop(steps=3), np.random.default_rng(0))


def test_every_estimator_takes_its_options_at_their_least_value():
    room = sources.simulation("room", np.random.default_rng(0))
    for name, taken in TAKES.items():
        assert name in estimators.NAMES
        for option in taken:
            each = OPTIONS[option]
            for value in getattr(each, "values", (getattr(each, "low", None),)):
                source = room if name.startswith("walls") else brief()
                assert estimators.make(name, source, **{option: value}).pose.shape == (3,)


def test_the_words_on_offer_are_those_the_estimators_know():
    assert OPTIONS["bounds"].values == tuple(BOUNDS)
    assert OPTIONS["association"].values == ASSOCIATORS


test_unsuitable_options_are_refused_in_one_line = refuses(
    lambda given: estimators.make(given[0], brief(), **given[1]),
    (("icp", {"bounds": "tuned"}), "icp does not take the option bounds.*use it with bor"),
    (("mak", {"freeze_distance": 0}), r"\(it takes smoothing\); use it with montecarlo"),
    (("bor", {"colour": 1}), r"take the option colour \(it takes bounds, association\)$"),
    (("bor", {"bounds": "wide"}), "bounds of bor must be conservative or tuned, not 'wide'"),
    (("fastslam", {"particles": "1.5"}), "must be a whole number from 1 to 100000, not '1.5'"),
    (("montecarlo", {"freeze_distance": "nan"}), "must be a number from 0.0, not 'nan'"),
    (("montecarlo", {"freeze_distance": -0.1}), "freeze_distance of montecarlo"),
    (("walls-foot-points", {"corrections": "some"}), "must be none or all, not 'some'"),
    (("mak", {"smoothing": "1"}), "from 0.0 to below 1.0"),
)


def test_a_number_may_come_as_text_and_a_whole_one_stays_whole():
    assert checked("montecarlo", {"particles": "1e2", "freeze_distance": "0"}) == {
        "particles": 100,
        "freeze_distance": 0.0,
    }
    assert estimators.make("fastslam", brief(), particles="7").filter.robot.rows.shape == (7, 3)


def test_the_command_passes_them_on_and_lists_them_in_its_summary(tmp_path):
    messages = ["run", "sim:landmarks", "--estimator", "fastslam", "-p", "particles=20"]
    assert main([*messages, "--out", str(tmp_path)]) == 0
    assert json.loads((tmp_path / "summary.json").read_text())["options"] == {"particles": 20}


def test_corrections_and_relocalisation_are_switched_by_their_options():
    room = sources.simulation("room", np.random.default_rng(0))
    assert estimators.make("walls-foot-points", room).corrections == frozenset()
    corrected = estimators.make("walls-foot-points", room, corrections="all")
    assert corrected.corrections == frozenset(estimators.CORRECTIONS)
    assert estimators.make("walls", room).relocalise
    assert not estimators.make("walls", room, relocalise="no").relocalise
