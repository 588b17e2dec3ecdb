"""Rows that are spooled come back as they were, from memory and from the file alike."""

import numpy as np
import pytest

from slamlab.readings import Reading, Scan
from slamlab.sources import SourceError, disk_buffer
from slamlab.sources.disk_buffer import DiskBuffer


def readings(count, beams=50):
    rng, angles = np.random.default_rng(1), np.linspace(-1, 1, beams)
    for i in range(count):
        own = angles if i % 3 else np.sort(rng.uniform(-3, 3, beams))
        odometry = None if i % 2 else rng.normal(size=3)
        yield Reading(0.1 * i, odometry, Scan(own.copy(), rng.uniform(0, 5, beams), 5.0))


@pytest.mark.parametrize("room", [10**9, 10_000, 0])
def test_readings_come_back_equal_whether_in_memory_or_in_a_file(monkeypatch, room):
    monkeypatch.setattr(disk_buffer, "IN_MEMORY", room)
    rows, kept = list(readings(60)), DiskBuffer()
    for row in rows:
        kept.append(row)
    assert len(kept) == 60
    for _ in range(2):
        for given, back in zip(rows, kept, strict=True):
            assert given.time == back.time
            assert (given.odometry is None) == (back.odometry is None)
            assert given.odometry is None or np.array_equal(given.odometry, back.odometry)
            assert np.array_equal(given.scan.angles, back.scan.angles)
            assert np.array_equal(given.scan.ranges, back.scan.ranges)


def test_two_iterations_do_not_disturb_each_other(monkeypatch):
    monkeypatch.setattr(disk_buffer, "IN_MEMORY", 300)
    kept = DiskBuffer()
    for i in range(9):
        kept.append((i, np.full(3, i)))
    assert [a[0] + b[0] for a, b in zip(kept, kept, strict=True)] == [2 * i for i in range(9)]


def test_a_full_disk_is_reported_in_one_sentence(monkeypatch):
    def full():
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(disk_buffer, "IN_MEMORY", 0)
    monkeypatch.setattr(disk_buffer, "TemporaryFile", full)
    with pytest.raises(SourceError, match=r"no space left.*TMPDIR"):
        DiskBuffer().append((1,))
