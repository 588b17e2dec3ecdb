"""Commands of studies: what they write, and what they refuse in one line."""

import json
from dataclasses import asdict

import pytest

from course.studies import (
    box_containment,
    consistency,
    filter_comparison,
    filter_consistency,
    foot_point_ablation,
    intel_maps,
    particle_filters,
    rplidar_a2_noise,
    study_command,
    ultrasound_walls,
    victoria_park,
    wall_slam_faults,
    wall_slam_variants,
)
from slamlab.sources.landmark_runs import Loop

# what gives one run of each table, by its seed
RUN = {
    "box_containment": box_containment.violations,
    "consistency": consistency.errors_of,
    "consistency-noisy": consistency.errors_of,
    "filter_comparison": filter_comparison.run,
    "filter_consistency": filter_consistency.run,
    "particle_filters": particle_filters.one_run,
    "ultrasound_walls": ultrasound_walls.errors_of,
    "wall_slam_faults": wall_slam_faults.errors_of,
    "wall_slam_variants": wall_slam_variants.errors_of,
}
# a run takes minutes; compared as a whole with what its recordings give
OTHERS = {"foot_point_ablation", "rplidar_a2_noise"}


def short(module):
    return module.__name__.rpartition(".")[2]


def test_every_stored_table_can_be_made_again():
    assert {path.stem for path in study_command.TABLES.glob("*.json")} == RUN.keys() | OTHERS


@pytest.mark.slow
@pytest.mark.parametrize("number", range(study_command.STORED_RUNS))
@pytest.mark.parametrize("name", RUN)
def test_a_run_of_a_stored_table_is_what_its_seed_gives(name, number):
    table = study_command.stored(name)
    more = {"loop": Loop(**table["scenario"])} if "scenario" in table else {}
    run = RUN[name](table.get("seeds", [0])[0] + number, **more)
    (found,) = study_command.first_runs([run])
    assert found == pytest.approx(table["first_runs"][number], rel=1e-4, abs=1e-6)


@pytest.mark.parametrize("module", [consistency, box_containment], ids=short)
def test_a_command_writes_its_words_seeds_versions_and_scenario(module, tmp_path, capsys):
    out = tmp_path / "new" / "table.json"
    more = ["--steps", "15"] if module is consistency else []
    words = ["--runs", "3", "--jobs", "1", *more, "--out", str(out)]
    assert module.main(words) == 0
    table = json.loads(out.read_text())
    assert json.loads(capsys.readouterr().out) == table
    assert table["command"].endswith(" ".join(words))
    assert table["seeds"] == [0, 2]
    assert not more or table["scenario"] == asdict(Loop(steps=15))
    assert more or table["counted"]["steps"] == 600
    assert {"python", "slamlab", "numpy"} <= set(table["versions"])


@pytest.mark.parametrize(
    ("module", "words", "message"),
    [
        (consistency, ["--runs", "1"], "at least 3"),
        (consistency, ["--v", "0"], "must be positive"),
        (consistency, ["--steps", "9"], "--steps"),
        (consistency, ["--jobs", "0"], "at least 1"),
        (box_containment, ["--runs", "0"], "--runs must be at least 1"),
        (filter_comparison, ["--runs", "2"], "at least 3"),
        (particle_filters, ["--runs", "3"], "at least 6"),
        (rplidar_a2_noise, [], "slamlab data get rplidar-a2-1"),
        (intel_maps, [], "slamlab data get intel"),
        (victoria_park, [], "slamlab data get victoria-park"),
    ],
)
def test_wrong_use_and_a_missing_recording_are_refused_in_one_line(
    module, words, message, tmp_path, monkeypatch, capsys
):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path))
    assert module.main([*words, "--out", str(tmp_path / "x")]) == 2
    output = capsys.readouterr().err
    assert message in output
    assert output.count("\n") == 1
    assert not (tmp_path / "x").exists()


@pytest.mark.parametrize(
    "module", [wall_slam_faults, ultrasound_walls, foot_point_ablation], ids=short
)
def test_fewer_than_six_runs_give_no_interval(module):
    with pytest.raises(ValueError, match="at least 6, not 5"):
        module.study(5)
