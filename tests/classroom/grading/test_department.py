"""The marks of a simulated department equal a plain reference, in any order of events."""

import csv
import math
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading import result_storage
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.ledger import chain_verification
from classroom.grading.records import Record
from classroom.grading.term import term
from tests.classroom.grading.conftest import forget, table

DUE = datetime(2025, 12, 1, 11, tzinfo=UTC)
GRACE, PER_DAY, AT_MOST = timedelta(minutes=10), 0.1, 0.5
SMALL = [f"{i:02}" for i in (4, 6)]
WHOLE = [f"{i:02}" for i in range(1, 16)]


def department(rng, students, exercises):
    """Extensions and attempts at random: late, repeated, unreadable, or of unknown students."""
    extensions, attempts = {}, {}
    for student in [*(f"s{i}" for i in range(students)), "not in the roster: Zed"]:
        for exercise in exercises:
            if rng.random() < 0.2:
                extensions[student, exercise] = DUE + timedelta(days=int(rng.integers(1, 5)))
            for number in range(rng.choice([0, 1, 1, 2, 3])):
                when = DUE + timedelta(minutes=int(rng.integers(-3000, 9000)))
                points = None if rng.random() < 0.1 else float(rng.integers(0, 9))
                attempts[student, exercise, number] = when, points
    return extensions, attempts


def reference(student, exercise, attempts, extensions, by_hand, rule):
    """The mark of a student in an exercise; None for none. Attempts are listed as first seen."""
    due, scored = extensions.get((student, exercise), DUE), []
    for number in range(3):
        key = student, exercise, number
        when, points = attempts.get(key, (DUE, None))
        points = by_hand.get(key, points) if key in attempts else None
        if points is not None:
            late = when - due
            days = math.ceil(late / timedelta(days=1)) if late > GRACE else 0
            scored.append(points * (1 - min(AT_MOST, PER_DAY * days)))
    if not scored:
        return None
    return scored[-1] if rule == "last" else max(scored)


def write_course(folder, students, exercises, extensions, rule):
    late = f"grace_minutes = 10\nper_day = {PER_DAY}\nat_most = {AT_MOST}\n"
    tables = "".join(f"[exercises.{id}]\ndue = 2025-12-01T12:00:00\n" for id in exercises)
    head = f'time_zone = "Europe/Zagreb"\nattempts = "{rule}"\n[late]\n{late}{tables}'
    (folder / "course.toml").write_text(head, "utf-8")
    with open(folder / "roster.csv", "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["id", "name", "email", "section", *exercises])
        for i in range(students):
            due = [extensions.get((f"s{i}", id)) for id in exercises]
            cells = [when.isoformat() if when else "" for when in due]
            rows.writerow([f"s{i}", f"Name {i}", "", "ABC"[i % 3], *cells])


def record(key, attempts, seen):
    (student, exercise, number), (when, points) = key, attempts[key]
    made = {"sha256": f"{student} {exercise} {number}", "seed": "b", "seen": seen[name(key)]}
    made |= {"titles": {f"{exercise}-x": "A task"}, "handed_in": when.isoformat()}
    if points is None:
        made["reason"] = "empty"
    else:
        made["verdicts"] = (Verdict(f"{exercise}-x", points, 12),)
    return Record(name(key), student, exercise, **made)


def name(key):
    student, exercise, number = key
    return f"{student}/{exercise}_{number}.ipynb"


def regraded(rng, attempts, exercise):
    """Attempts of an exercise that has other points now."""
    return attempts | {
        key: (when, points and float(rng.integers(0, 9)))
        for key, (when, points) in attempts.items()
        if key[1] == exercise
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    ("students", "exercises"), [(30, SMALL), pytest.param(300, WHOLE, marks=pytest.mark.walk)]
)
@pytest.mark.parametrize("kind", ["sqlite", "postgresql"])
@pytest.mark.parametrize("rule", ["last", "best"])
def test_every_mark_equals_a_plain_reference(tmp_path, rule, kind, students, exercises, request):
    rng = np.random.default_rng(len(rule) + students)
    extensions, attempts = department(rng, students, exercises)
    write_course(tmp_path, students, exercises, extensions, rule)
    made = term.load(tmp_path / "course.toml")
    made.course.results.mkdir()
    url = default_url(made.course.results)
    if kind == "postgresql":
        url = request.getfixturevalue("postgres")
        forget(url)
    by_hand, keys, policy = {}, list(attempts), made.policy
    with Gradebook(url) as book:
        seen = book.number_submissions([(name(key), "x") for key in keys])
        book.add_all([record(keys[i], attempts, seen) for i in rng.permutation(len(keys))])
        for i in rng.permutation(len(keys))[: len(keys) // 5]:
            points, task = float(rng.integers(0, 9)), f"{keys[i][1]}-x"
            book.override_points(record(keys[i], attempts, seen), task, points, "by hand")
            by_hand[keys[i]] = points
        for exercise in exercises[:2]:  # two regrades, one of them after one that was broken off
            attempts = regraded(rng, attempts, exercise)
            again = [record(key, attempts, seen) for key in keys if key[1] == exercise]

            def broken_off(again=again):
                yield from again[: len(again) // 2]
                raise KeyboardInterrupt

            words = made.course.results, book, None, policy, True, {}, made, seen
            with pytest.raises(KeyboardInterrupt):
                list(result_storage.store_records(broken_off(), *words))
            list(result_storage.store_records((each for each in again), *words))
        last = exercises[-1]  # a law that changed: everybody gains half a point
        milder = {key: (when, points + 0.5) for key, (when, points) in attempts.items()
                  if key[1] == last and points is not None}  # fmt: skip
        attempts |= milder
        known = {r.submission: r for r in book.attempts().values()}
        again = [replace(known[name(key)], verdicts=record(key, attempts, seen).verdicts)
                for key in milder]  # fmt: skip
        assert book.add_all(again, why="rejudged") == 0
        found = made.exercise_results(book)
        made.write(book)
        assert len(book.attempts()) == len(attempts)
        assert chain_verification.find_alterations(book.rows()) == []
    words = attempts, extensions, by_hand, rule
    for exercise in exercises:
        for result in found[exercise]:
            expected = reference(result.student.id, exercise, *words)
            assert result.total == (None if expected is None else pytest.approx(expected))
    rows = table(made.course.results / "grades.csv")
    assert [row["id"] for row in rows] == [f"s{i}" for i in range(students)]
    for row in rows:
        totals = [reference(row["id"], exercise, *words) or 0 for exercise in exercises]
        assert float(row["total"]) == pytest.approx(sum(totals), abs=1e-3)
    assert len(table(made.course.results / "submissions.csv")) == len(attempts)
