"""Copies share rare code, also after renaming, and rank above independent answers."""

import itertools
import json
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

from classroom.coursework import originals
from classroom.exercises import catalogue
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.ledger import contents
from classroom.grading.notebooks import parse
from classroom.grading.records import Record
from classroom.grading.similarity import class_similarity, code_tokens
from classroom.grading.similarity.class_similarity import GIVEN, OWN, SHARED, ClassSimilarity
from classroom.grading.similarity.code_tokens import grams, tokens
from classroom.grading.similarity.similarity_report import original_grams
from course.task_programs import programs
from slamlab.cli import main

EXERCISES = Path(__file__).parents[3] / "exercises"


def cells_of(id):
    """The code of an exercise as it was handed out, but for the cells that wait for a solution."""
    data = (EXERCISES / catalogue.exercise(id).file).read_bytes()
    return [source for _, source in parse(data).cells if "NotImplementedError" not in source]


def given(id):
    return {gram for source in cells_of(id) for gram, _, _ in grams(source)}


def submission(id, solutions):
    return list(enumerate([*cells_of(id), *solutions], 1))


def solutions_of(id, rng, right_only):
    """Students of whom no two have the same answer to any task, as lists of sources."""
    kinds = ("way", "right") if right_only else ("right", "wrong")  # ways share helpers with right
    found = {
        one.task.id: [answer.source for answer in one.answers if answer.kind in kinds]
        for one in programs(id)
    }
    shuffled = [[each[i] for i in rng.permutation(len(each))] for each in found.values()]
    return [list(one) for one in zip(*shuffled, strict=False)]


def disguised(sources, rng):
    """The same with all own names changed, other comments and docstrings, in another order."""
    made = []
    for source in sources:
        own = set(re.findall(r"(?<![.\w])([a-zA-Z_]\w*)(?= *(?:,[^()=]*)?= )", source))
        names = {name: f"name{rng.integers(1_000_000)}" for name in own - {"np", "axis"}}
        source = re.sub(r"(?<![.\w])[a-zA-Z_]\w*", lambda m: names.get(m[0], m[0]), source)  # noqa: B023
        source = re.sub(r"#.*", "", source)
        source = re.sub(r"(?m)(?<=:)$", f"  # {rng.integers(1_000_000)} words", source)
        source = re.sub(r"(\n+def .*:.*\n)", r'\1    """Mine, my own."""\n', source)
        made.append(source)
    return [made[i] for i in rng.permutation(len(made))]


@pytest.mark.parametrize("id", [id for id in catalogue.EXERCISES if programs(id)])
@pytest.mark.parametrize("right_only", [True, False])
def test_disguised_copies_rank_above_all_independent_answers(id, right_only):
    rng = np.random.default_rng(int(id))
    independent = solutions_of(id, rng, right_only)
    members = {f"s{i}": submission(id, mine) for i, mine in enumerate(independent)}
    copied = set()
    for i in range(min(3, len(independent))):
        members[f"copy{i}"] = submission(id, disguised(independent[i], rng))
        copied.add((f"s{i}", f"copy{i}"))
    pairs = ClassSimilarity(members, given(id)).pairs
    assert {(pair.left, pair.right) for pair in pairs[: len(copied)]} == copied
    others = [pair.score for pair in pairs[len(copied) :]]
    assert pairs[len(copied) - 1].score > 1.2 * max(others, default=0)


def idle(source, rng):
    """The source with idle lines inserted."""
    lines = source.split("\n")
    for i in range(len(lines) - 2, 0, -3):
        if not lines[i].rstrip().endswith((":", ",", "(", "[")):
            indent = lines[i][: len(lines[i]) - len(lines[i].lstrip())]
            lines.insert(i + 1, f"{indent}idle{i} = {rng.integers(99)}")
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("how", "id"), [("idle", "04"), *itertools.product(("half", "idle"), ("06", "10", "15"))]
)
def test_a_half_copied_submission_and_one_with_idle_lines_rank_first(how, id):
    rng = np.random.default_rng(1)
    *others, last = solutions_of(id, rng, right_only=False)
    if how == "half":
        copy = disguised(others[0][:3], rng) + last[3:]
    else:
        copy = [idle(source, rng) for source in disguised(others[0], rng)]
    members = {f"s{i}": submission(id, one) for i, one in enumerate(others)}
    best = ClassSimilarity(members | {"copy": submission(id, copy)}, given(id)).pairs[0]
    assert (best.left, best.right) == ("s0", "copy")
    assert 0.2 < best.share < 0.95 if how == "half" else best.share > 0.3


COMMON = "def f(a, b):\n    c = a + b * 2\n    d = c - a / (b + 1)\n    return d * c + a - b\n"
RARE = (
    "def g(a):\n    for i in range(7):\n        a = a[i] ** 3 - len(a) // (i + 5)\n    return [a]\n"
)


def numbered(*cells):
    return list(enumerate(cells, 1))


def test_code_of_more_than_half_and_original_code_do_not_count():
    members = {name: numbered(COMMON) for name in "abc"} | {"d": [], "e": []}
    assert ClassSimilarity(members).pairs == []
    members = {"a": numbered(RARE), "b": numbered(RARE), "c": [], "d": []}
    assert len(ClassSimilarity(members).pairs) == 1
    assert ClassSimilarity(members, {gram for gram, _, _ in grams(RARE)}).pairs == []


def test_pairs_that_share_rarer_code_rank_higher():
    filler = [f"x = [{', '.join(f'{i * j} + {j}' for j in range(30))}]" for i in range(2, 10)]
    members = {f"s{i}": numbered(COMMON, filler[i]) for i in range(4)}
    members |= {f"s{i}": numbered(filler[i]) for i in range(4, 6)}
    members |= {"p": numbered(RARE, filler[6]), "q": numbered(RARE, filler[7])}
    first, *rest = ClassSimilarity(members).pairs
    assert (first.left, first.right) == ("p", "q")
    assert len(rest) == 6 and all(pair.score < first.score for pair in rest)


def test_side_by_side_every_line_is_shared_given_or_own():
    left = numbered("import numpy as np", COMMON, RARE + "y = {1: 'a', 2: 'b', 3: 'c', 4: 'd'}\n")
    right = numbered(COMMON, "\n" + re.sub(r"\ba\b", "other", RARE))
    both = ClassSimilarity({"l": left, "r": right, "x": []}, {g for g, _, _ in grams(COMMON)})
    (mine,), (theirs,) = both.side_by_side("l", "r")
    assert (mine[0], theirs[0]) == (3, 2)  # what is all given is left out
    assert [kind for _, kind, _ in mine[1]] == [SHARED] * 4 + [OWN, GIVEN]
    assert [kind for _, kind, _ in theirs[1]] == [GIVEN] + [SHARED] * 4 + [GIVEN]
    assert mine[1][0][2] == (2, 2) and theirs[1][1][2] == (3, 1)
    assert "\n".join(text for text, _, _ in mine[1]) == left[2][1]
    with pytest.raises(KeyError):
        both.side_by_side("l", "nobody")


def test_tokens_do_not_change_with_names_comments_and_layout():
    plain = "def f(x, n=2):\n    y = np.sin(x) ** n\n    return y['a']\n"
    other = (
        "def g(angle,\n  power=2):  # mine\n\n    '''Words\n    of mine.'''\n"
        '    s = np.sin( angle )**power # " \n    return s[f"b{1}"]'
    )
    assert [t for t, *_ in tokens(plain)] == [t for t, *_ in tokens(other)]
    assert [t for t, *_ in tokens("a.dot(b)")] != [t for t, *_ in tokens("a.sum(b)")]
    assert [t for t, *_ in tokens("a // 3")] != [t for t, *_ in tokens("a / 3")]
    assert tokens("") == [] and grams("x = 1") == ()


@pytest.mark.parametrize("source", ["def (((", "%matplotlib inline\n!ls 'x\n", '"""never closed',
                                    "x = '\\", "\0\ud800\u202e", "'" * 7])  # fmt: skip
def test_text_that_is_not_python_is_tokenised_as_far_as_possible(source):
    for (_, first, last), (_, after, _) in itertools.pairwise([*tokens(source), ("", 99, 99)]):
        assert 0 <= first <= last <= source.count("\n") and first <= after


def test_the_regular_expression_never_backtracks():
    def operations(parsed):
        for name, given in parsed:
            yield str(name), given
            for part in given if isinstance(given, tuple | list) else ():
                for each in part if isinstance(part, list) else (part,):
                    if isinstance(each, re._parser.SubPattern):
                        yield from operations(each)

    found = list(operations(re._parser.parse(code_tokens._TOKEN.pattern, re.X | re.S)))
    assert sum(name == "POSSESSIVE_REPEAT" for name, _ in found) > 10
    for name, given in found:
        assert name != "MIN_REPEAT" and (name != "MAX_REPEAT" or given[0] == given[1])


def test_a_notebook_with_too_much_code_is_named_and_not_compared(monkeypatch):
    monkeypatch.setattr(class_similarity, "MAX_CHARACTERS", 500)
    members = {"a": numbered(RARE), "b": numbered(RARE), "c": numbered("x" * 501)}
    found = ClassSimilarity(members)
    assert found.too_long == ["c"] and found.count == 2 and len(found.pairs) == 1


def test_empty_classes_and_submissions_have_no_pairs():
    for members in ({}, {"a": []}, {"a": [], "b": numbered("")}):
        assert ClassSimilarity(members).pairs == []


def test_original_notebooks_are_read_from_the_pack_or_missing(tmp_path):
    notebook = (EXERCISES / catalogue.exercise("04").file).read_text("utf-8")
    lesson = json.loads(notebook) | {"metadata": {"slamlab": {"lesson": "04"}}}
    (tmp_path / originals.ARCHIVE).parent.mkdir(parents=True)
    with zipfile.ZipFile(tmp_path / originals.ARCHIVE, "w") as pack:
        pack.writestr("notebooks/04_x.ipynb", json.dumps(lesson))
    assert given("04") <= original_grams(tmp_path)
    assert original_grams(tmp_path / "nowhere") is None
    assert original_grams(EXERCISES / "nothing of the course below a clone") is None
    assert original_grams(EXERCISES.parent / "docs") is None


def test_the_command_lists_pairs_and_who_was_not_compared(tmp_path, capsys):
    rows = {"s1": RARE, "s2": re.sub(r"\ba\b", "b", RARE), "s3": COMMON, "s4": None}
    (tmp_path / "out").mkdir()
    with Gradebook(default_url(tmp_path / "out")) as book:
        for student, source in rows.items():
            data = contents.packed(json.dumps([[1, source]]).encode()) if source else None
            kept = {"cells": contents.name_of(data)} if data else {}
            held = {kept["cells"]: data} if data else {}
            book.add(Record(f"{student}.ipynb", student, "04", sha256=student, seed="b" * 64,
                            kept=kept, contents=held))  # fmt: skip
    words = ["--out", str(tmp_path / "out")]
    assert main(["grade", "similarity", "4", *words]) == 0
    output = capsys.readouterr().out
    assert "04: 3 submissions compared\n  100 %  s1 – s2\n" in output
    assert "not compared: s4: its cells are not stored" in output and "s3" not in output
    assert main(["grade", "similarity", "05", *words]) == 0
    assert capsys.readouterr().out == "05: no submissions\n"
    assert main(["grade", "similarity", "77", *words]) == 2
    assert main(["grade", "similarity", "--out", str(tmp_path / "none")]) == 2
