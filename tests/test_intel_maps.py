"""The stored maps of the Intel log: what the lessons say of them, and where they come from."""

import numpy as np
import pytest

from slamlab import sources
from slamlab.sources import SourceError
from slamlab.studies import intel_maps


def test_the_stored_maps_say_what_the_lesson_says():
    maps = intel_maps.stored()
    wheels, scans = (np.ptp(maps.points[name], axis=0).max() for name in ("odometry", "icp"))
    assert wheels > 2 * scans, "the map of the wheels is twice as large"
    assert maps.off["icp"] < 0.1 * maps.off["odometry"]
    assert maps.off["graph"] < 0.2 * maps.off["icp"], "loops closed mend what matching leaves"
    assert maps.off["icp-plain"] > 0.9 * maps.off["odometry"], (
        "plain ICP is worth no more than wheels"
    )
    assert maps.relations > 100
    assert maps.loops.shape == (len(maps.loops), 4)
    places = set(map(tuple, maps.track))
    assert all(tuple(row[:2]) in places and tuple(row[2:]) in places for row in maps.loops)
    assert maps.readings == 910
    assert maps.way > 10 * scans, "the robot came by the same corridors several times"


def test_without_the_recording_the_command_says_so_in_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path))
    assert intel_maps.main(["--out", str(tmp_path / "maps.npz")]) == 2
    assert "SLAMLAB_DATA" in capsys.readouterr().err
    assert not (tmp_path / "maps.npz").exists()


@pytest.mark.slow
def test_the_recording_gives_the_stored_maps(tmp_path):
    try:
        for name in ("intel", "intel-relations"):
            sources.recording(name)
    except SourceError as missing:
        pytest.skip(str(missing))
    assert intel_maps.main(["--out", str(tmp_path / "maps.npz")]) == 0
    with np.load(tmp_path / "maps.npz") as made, np.load(intel_maps.TABLE) as kept:
        assert set(made) == set(kept)
        for name in (*intel_maps.ERRORS, "relations", "readings", "driven"):
            # processors round differently, and a log of 900 m magnifies that: 1.1 % were seen
            np.testing.assert_allclose(made[name], kept[name], rtol=0.05)
        for name in intel_maps.SIDES:  # cells: another machine rounds a point into the next
            same = set(map(tuple, made[name])) & set(map(tuple, kept[name]))
            assert len(same) > 0.9 * len(kept[name])
