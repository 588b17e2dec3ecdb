"""A made-up department's marks are those of a plain reference, whatever order things came in."""

import csv
import math
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest

from slamlab.exercises.verdict import Verdict
from slamlab.grading.gradebook import Gradebook, default_url
from slamlab.grading.records import Record
from slamlab.grading.term import term

EXERCISES = ("04", "99")
DUE = datetime(2026, 12, 1, 11, tzinfo=UTC)
GRACE, PER_DAY, AT_MOST = timedelta(minutes=10), 0.1, 0.5


def department(rng, students):
    """Extensions and attempts at random: late, double, unreadable, of nobody, of none."""
    extensions, attempts = {}, []
    for student in [*(f"s{i}" for i in range(students)), "not in the roster: Zed"]:
        for exercise in EXERCISES:
            if rng.random() < 0.2:
                extensions[student, exercise] = DUE + timedelta(days=int(rng.integers(1, 5)))
            for number in range(rng.choice([0, 1, 1, 2, 3])):
                when = DUE + timedelta(minutes=int(rng.integers(-3000, 9000)))
                points = None if rng.random() < 0.1 else float(rng.integers(0, 9))
                attempts.append((student, exercise, number, when, points))
    return extensions, attempts


def reference(student, exercise, attempts, extensions, by_hand, rule):
    """The mark of a student in an exercise; None for none."""
    due, scored = extensions.get((student, exercise), DUE), []
    for who, what, number, when, points in attempts:
        points = by_hand.get((who, what, number), points)
        if (who, what) == (student, exercise) and points is not None:
            late = when - due
            days = math.ceil(late / timedelta(days=1)) if late > GRACE else 0
            scored.append((when, points * (1 - min(AT_MOST, PER_DAY * days))))
    if not scored:
        return None
    return max(scored)[1] if rule == "last" else max(total for _, total in scored)


def write_course(folder, students, extensions, rule):
    late = f"grace_minutes = 10\nper_day = {PER_DAY}\nat_most = {AT_MOST}\n"
    tables = "".join(f"[exercises.{id}]\ndue = 2026-12-01T12:00:00\n" for id in EXERCISES)
    head = f'time_zone = "Europe/Zagreb"\nattempts = "{rule}"\n[late]\n{late}{tables}'
    (folder / "course.toml").write_text(head, "utf-8")
    with open(folder / "roster.csv", "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["id", "name", "email", "section", *EXERCISES])
        for i in range(students):
            due = [extensions.get((f"s{i}", id)) for id in EXERCISES]
            cells = [when.isoformat() if when else "" for when in due]
            rows.writerow([f"s{i}", f"Name {i}", "", "ABC"[i % 3], *cells])


def record(attempt):
    student, exercise, number, when, points = attempt
    made = {"sha256": f"{student} {exercise} {number}", "seed": "b"}
    made["titles"] = {f"{exercise}-x": "A task"}
    if points is None:
        made["reason"] = "empty"
    else:
        made["verdicts"] = (Verdict(f"{exercise}-x", points, 8),)
    name = f"{student}/{exercise}_{number}.ipynb"
    return Record(name, student, exercise, handed_in=when.isoformat(), **made)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("rule", ["last", "best"])
def test_every_mark_is_that_of_a_plain_reference(tmp_path, rule, seed):
    rng, students = np.random.default_rng(seed), 30
    extensions, attempts = department(rng, students)
    write_course(tmp_path, students, extensions, rule)
    made = term.load(tmp_path / "course.toml")
    made.course.results.mkdir()
    by_hand = {}
    with Gradebook(default_url(made.course.results)) as book:
        for index in rng.permutation(len(attempts)):
            book.add(record(attempts[index]))
        for index in rng.permutation(len(attempts))[:10]:
            student, exercise, number, *_ = attempts[index]
            points = float(rng.integers(0, 9))
            name = f"{student}/{exercise}_{number}.ipynb"
            book.override_points(name, exercise, f"{exercise}-x", points, "by hand")
            by_hand[student, exercise, number] = points
        found = made.standings(book)
        made.write(book)
        assert len(book.attempts()) == len(attempts)
    words = attempts, extensions, by_hand, rule
    for exercise in EXERCISES:
        for standing in found[exercise]:
            expected = reference(standing.student.id, exercise, *words)
            assert standing.total == (None if expected is None else pytest.approx(expected))
    with open(made.course.results / "grades.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["id"] for row in rows] == [f"s{i}" for i in range(students)]
    for row in rows:
        totals = [reference(row["id"], exercise, *words) or 0 for exercise in EXERCISES]
        assert float(row["total"]) == pytest.approx(sum(totals), abs=1e-4)
    with open(made.course.results / "submissions.csv", encoding="utf-8") as file:
        assert len(file.readlines()) == len(attempts) + 1
