"""Options of estimators: each takes its own and refuses the others', by name and with a reason."""

import json

import numpy as np
import pytest

from slamlab import estimators, sources
from slamlab.cli import main
from slamlab.estimators.bor_slam import BOUNDS
from slamlab.estimators.corner_names import NAMERS
from slamlab.estimators.options import OPTIONS, TAKES, checked
from slamlab.sources.landmark_runs import LandmarkRun, Loop


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
    assert OPTIONS["bounds"].values == tuple(BOUNDS) and OPTIONS["names"].values == NAMERS


@pytest.mark.parametrize(
    ("name", "options", "says"),
    [
        ("icp", {"bounds": "tuned"}, "icp does not take the option bounds.*bor would"),
        ("mak", {"close": 0}, r"\(it takes smoothing\); montecarlo would"),
        ("bor", {"colour": 1}, r"bor does not take the option colour \(it takes bounds, names\)$"),
        ("bor", {"bounds": "wide"}, "bounds of bor is honest or tuned, not 'wide'"),
        (
            "fastslam",
            {"samples": "1.5"},
            "samples of fastslam is a whole number from 1 to 100000, not '1.5'",
        ),
        ("fastslam", {"samples": "inf"}, "samples of fastslam"),
        ("montecarlo", {"samples": "1e9"}, "from 1 to 100000, not '1e9'"),
        ("montecarlo", {"close": "nan"}, "close of montecarlo is a number from 0.0, not 'nan'"),
        ("montecarlo", {"close": -0.1}, "close of montecarlo"),
        ("montecarlo", {"close": None}, "close of montecarlo"),
        ("walls-foot", {"mends": "some"}, "mends of walls-foot is none or all, not 'some'"),
        ("mak", {"smoothing": "1"}, "from 0.0 to below 1.0"),
    ],
)
def test_what_does_not_fit_is_refused_in_one_line(name, options, says):
    with pytest.raises(ValueError, match=says):
        estimators.make(name, brief(), **options)


def test_a_number_may_come_as_text_and_a_whole_one_stays_whole():
    assert checked("montecarlo", {"samples": "1e2", "close": "0"}) == {"samples": 100, "close": 0.0}
    assert estimators.make("fastslam", brief(), samples="7").filter.robot.rows.shape == (7, 3)


def test_the_command_hands_them_on_and_says_them_in_its_summary_and_help(tmp_path, capsys):
    said = ["run", "sim:landmarks", "--estimator", "fastslam", "--samples", "20"]
    assert main([*said, "--out", str(tmp_path)]) == 0
    assert json.loads((tmp_path / "summary.json").read_text())["options"] == {"samples": 20}
    assert main(["run", "sim:landmarks", "--estimator", "mak", "--bounds", "honest"]) == 2
    assert "mak does not take the option bounds" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["run", "--help"])
    shown = capsys.readouterr().out
    assert all(f"--{option}" in shown for option in OPTIONS)


def test_mends_and_relocalisation_are_switched_by_their_words():
    room = sources.simulation("room", np.random.default_rng(0))
    assert estimators.make("walls-foot", room).mends == frozenset()
    assert estimators.make("walls-foot", room, mends="all").mends == frozenset(estimators.MENDS)
    assert estimators.make("walls", room).relocalise
    assert not estimators.make("walls", room, relocalise="no").relocalise
