"""The audit ledger: altered rows are detected, and erased data are gone."""

import json
from dataclasses import replace

import pytest
import sqlalchemy as sa

from classroom.grading import gradebook_rows
from classroom.grading.gradebook import Gradebook, GradebookError
from classroom.grading.ledger import chain_merging, chain_verification, chains, contents
from tests.classroom.grading.test_gradebook import record


def at(folder, name="grades"):
    return f"sqlite:///{folder / name}.db"


def filled(opened, names="abc"):
    """A gradebook with an attempt of each, and points by hand for the first."""
    for name in names:
        opened.add(record(f"{name}.ipynb", student=name))
    opened.override_points(record(f"{names[0]}.ipynb"), "99-double", 2, "half right")
    return opened


def statement(opened, text, **values):
    """Do something to the database that the gradebook never does."""
    with opened._database._engine.begin() as connection:
        connection.execute(sa.text(text), values)


@pytest.mark.slow
def test_every_attempt_and_change_is_a_permanent_row(book):
    filled(book)
    before = book.rows()
    again = replace(record("a.ipynb", student="a"), seconds={"wall": 1.0})
    book.add(again)
    book.override_points(again, "99-double", 3, "more")
    assert book.rows()[: len(before)] == before
    assert [row["kind"] for row in book.rows()] == [
        "begin", "attempt", "attempt", "attempt", "override", "attempt", "override",
    ]  # fmt: skip
    assert [row["number"] for row in book.rows()] == list(range(7))
    assert chain_verification.find_alterations(book.rows()) == []


def test_a_row_contains_its_author(tmp_path):
    with Gradebook(at(tmp_path), "Prof. X") as opened:
        assert {row["who"] for row in filled(opened).rows()} == {"Prof. X"}
    with Gradebook(at(tmp_path)) as opened:
        opened.add(record("d.ipynb"))
        assert opened.rows()[-1]["who"] not in ("", "Prof. X")


ALTERED = {
    "the body": "body = replace(body, 'half right', 'all right') WHERE kind = 'override'",
    "points": "body = replace(body, '2.0', '3.0') WHERE kind = 'override'",
    "who": "who = 'somebody' WHERE number = 2",
    "when": "at = '2026-01-01' WHERE number = 2",
    "the order": "turn = 99 WHERE number = 2",
    "a digest": "digest = hash WHERE number = 2",
    "emptied": "body = NULL, salt = NULL WHERE number = 2",
    "deleted": None,
}


@pytest.mark.parametrize("how", ALTERED)
def test_the_first_row_that_was_altered_is_named(book, how):
    filled(book)
    change = f"UPDATE ledger SET {ALTERED[how]}"
    statement(book, change if ALTERED[how] else "DELETE FROM ledger WHERE number = 2")
    (message,) = chain_verification.find_alterations(book.rows())
    number = 4 if how in ("the body", "points") else 2
    assert message.startswith(f"row {number} of ledger ")


def test_the_next_row_or_a_noted_head_reveals_what_a_row_alone_hides(tmp_path):
    with filled(Gradebook(at(tmp_path))) as opened:
        head = opened.rows()[-1]["hash"]
        assert chain_verification.find_alterations(opened.rows(), [head]) == []
        statement(opened, "DELETE FROM ledger WHERE number = 4")
        assert chain_verification.find_alterations(opened.rows()) == []
        assert "removed" in chain_verification.find_alterations(opened.rows(), [head])[0]
        altered = chains.row_hash(opened.rows()[2] | {"who": "somebody"})
        text = "UPDATE ledger SET who = 'somebody', hash = :h WHERE number = 2"
        statement(opened, text, h=altered)
        (message,) = chain_verification.find_alterations(opened.rows())
        assert message.startswith("row 3 of ledger") and "the row before it" in message


def test_a_merge_records_both_heads_and_keeps_the_other_chain(tmp_path):
    with filled(Gradebook(at(tmp_path, "a"))) as one, Gradebook(at(tmp_path, "b")) as other:
        filled(other, "de")
        heads = [opened.rows()[-1]["hash"] for opened in (one, other)]
        assert one.merge(other) == 2
        assert one.merge(other) == 0
        last = one.rows()[-1]
        body = json.loads(last["body"])
        assert last["kind"] == "merge"
        assert [body["ours"][2], *(hash for _, hash in body["theirs"].values())] == heads
        assert chain_verification.find_alterations(one.rows()) == []
        assert len(chain_merging.heads(one.rows())) == 2
        assert len(one.attempts()) == 5
        statement(one, "DELETE FROM ledger WHERE kind = 'override' AND chain = :c",
                  c=other.rows()[0]["chain"])  # fmt: skip
        assert "merged row" in chain_verification.find_alterations(one.rows())[0]


def test_copies_that_diverged_are_not_merged(tmp_path):
    with filled(Gradebook(at(tmp_path, "a"))):
        pass
    (tmp_path / "b.db").write_bytes((tmp_path / "a.db").read_bytes())
    with Gradebook(at(tmp_path, "a")) as one, Gradebook(at(tmp_path, "b"), "Tutor") as other:
        assert one.merge(other) == 0
        one.add(record("x.ipynb"))
        other.add(record("y.ipynb"))
        other.override_points(record("a.ipynb"), "99-double", 1, "by hand")
        message = r"gradebooks differ in row.*, Tutor added rows.*\(attempt: 1, override: 1\)"
        with pytest.raises(GradebookError, match=message):
            one.merge(other)
        assert chain_verification.find_alterations(one.rows()) == []


def test_a_copy_made_by_merging_can_be_merged_back(tmp_path):
    with filled(Gradebook(at(tmp_path, "a"))) as one, Gradebook(at(tmp_path, "b")) as copy:
        copy.merge(one)
        one.add(record("x.ipynb"))
        copy.add(record("y.ipynb"))
        assert one.merge(copy) == 1
        assert copy.merge(one) == 1
        for opened in (one, copy):
            assert chain_verification.find_alterations(opened.rows()) == []
            assert len(opened.attempts()) == 5


def test_erased_data_are_not_in_the_file_and_the_chain_is_valid(tmp_path):
    name, cells = "Ana Kosovac", contents.packed(b"her very own code" * 9)
    sha256 = contents.name_of(cells)
    kept = {"kept": {"cells": sha256}, "contents": {sha256: cells}}
    with Gradebook(at(tmp_path)) as opened:
        filled(opened)
        opened.number_submissions([(f"{name}.ipynb", "x")])
        made = record(f"{name}.ipynb", student=name, **kept)
        opened.add(made)
        opened.override_points(made, "99-double", 2, f"{name} agreed")
        hashes = [row["hash"] for row in opened.rows()]
        assert [gone.submission for gone in opened.forget(name)] == [f"{name}.ipynb"]
        assert opened.forget(name) == []
        assert [row["hash"] for row in opened.rows()][: len(hashes)] == hashes
        assert chain_verification.find_alterations(opened.rows()) == []
        assert {r.student for r in opened.attempts().values()} == {"a", "b", "c"}
        assert opened.contents(kept["kept"].values()) == {}
    data = (tmp_path / "grades.db").read_bytes()
    assert name.encode() not in data
    assert cells[:16] not in data
    assert record().sha256.encode() in data  # the file's hash, which contains no name


def test_merging_does_not_restore_erased_data(tmp_path):
    with filled(Gradebook(at(tmp_path, "a"))) as one, Gradebook(at(tmp_path, "b")) as other:
        other.merge(one)
        other.forget("a")
        other.merge(one)
        assert {r.student for r in other.attempts().values()} == {"b", "c"}
        one.merge(other)
        assert {r.student for r in one.attempts().values()} == {"b", "c"}
        assert one.overrides() == {}
        for opened in (one, other):
            assert chain_verification.find_alterations(opened.rows()) == []


def test_contents_are_stored_once_while_an_attempt_names_them(book):
    data = contents.packed(b"x" * 100)
    name = contents.name_of(data)
    kept = {"kept": {"cells": name}, "contents": {name: data}}
    for student in "ab":
        book.add(record(f"{student}.ipynb", student=student, **kept))
    assert book.contents([name, "0" * 64]) == {name: data}
    book.forget("a")
    assert book.contents([name]) == {name: data}
    book.forget("b")
    assert book.contents([name]) == {}


def test_too_long_contents_are_not_stored_and_damaged_ones_reported(tmp_path):
    noise = b"".join(bytes([i * i * 7 % 251, i % 256]) for i in range(10**5))
    assert len(contents.packed(noise) or b"") <= contents.MAX_BYTES
    assert contents.unpacked(contents.packed(b"abc")) == b"abc"
    for data in (b"", b"x", contents.packed(b"abc" * 99)[:-3]):
        with pytest.raises(contents.ContentError):
            contents.unpacked(data)


OLDER = """
CREATE TABLE attempts (id INTEGER PRIMARY KEY, key VARCHAR(64), submission TEXT, student TEXT,
    exercise VARCHAR(8), sha256 VARCHAR(64), score FLOAT, max_score FLOAT, isolation VARCHAR(8),
    at VARCHAR(32), record JSON);
CREATE TABLE adjustments (id INTEGER PRIMARY KEY, submission TEXT, exercise VARCHAR(8), task TEXT,
    points FLOAT, reason TEXT, at VARCHAR(32));
INSERT INTO adjustments VALUES (1, 'a.ipynb', '99', '99-double', 1, 'x', '2026-01-01'),
    (2, 'a.ipynb', '99', '99-double', 2, 'y', '2026-01-01');
"""


def test_a_gradebook_without_a_ledger_is_migrated_once(tmp_path):
    older = [record("a.ipynb"), record("b.ipynb"), record("a.ipynb", sha="c" * 64)]
    engine = sa.create_engine(at(tmp_path))
    with engine.begin() as connection:
        for text in OLDER.split(";")[:-1]:
            connection.execute(sa.text(text))
        for made in older:
            body = gradebook_rows.stored(made)
            values = {"k": body["key"], "s": made.submission, "r": json.dumps(body["record"])}
            text = "INSERT INTO attempts (key, submission, at, record) VALUES (:k, :s, '2026', :r)"
            connection.execute(sa.text(text), values)
    engine.dispose()
    for _ in range(2):
        with Gradebook(at(tmp_path)) as opened:
            assert list(opened.attempts().values()) == older
            assert opened.overrides() == {("a.ipynb", "", "99-double"): (2.0, "y")}
            assert chain_verification.find_alterations(opened.rows()) == []
            tables = sa.inspect(opened._database._engine).get_table_names()
    assert set(tables) == {"ledger", "contents", "sightings"}


def test_attempts_are_ordered_by_their_first_reading(book):
    first = book.number_submissions([("a", "1"), ("b", "1")])
    later = book.number_submissions([("a", "2"), ("b", "1"), ("c", "1")])
    assert later == {"a": 3, "b": first["b"], "c": 4}
    assert book.number_submissions([("a", "1")]) == {"a": first["a"]}
