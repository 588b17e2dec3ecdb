"""Independent right answers keep their points; wrong ones lose some, and a student learns why."""

import pytest

from classroom.exercises import catalogue
from course import answers, mistakes
from course.task_programs import programs
from course.task_report import answers_report

PROGRAMS = {one.task.id: one for id in catalogue.EXERCISES for one in programs(id)}


@pytest.mark.slow
@pytest.mark.parametrize("id", PROGRAMS)
def test_independent_answers_are_judged_rightly_and_a_student_learns_why_one_is_wrong(id):
    misjudged, kinds = answers_report(PROGRAMS[id])
    assert [answer.what for answer, _ in misjudged] == []
    assert kinds["silent"] == 0


TWO = """\
# %% right: by the norm
def distance(a, b):
    return np.linalg.norm(b - a)

# %% wrong: no root
def distance(a, b):
    return (b - a) @ (b - a)
"""


def test_programs_are_read_from_plain_code(tmp_path):
    file = tmp_path / "answers.py"
    file.write_text(TWO)
    right, wrong = answers.read(file)
    assert (right.kind, right.what) == ("right", "by the norm")
    assert wrong.source == "def distance(a, b):\n    return (b - a) @ (b - a)"


@pytest.mark.parametrize(("text", "line"), [("# %% correct: x\n", 1), ("\ndef f(): pass\n", 2)])
def test_an_error_in_a_file_of_answers_is_reported_with_its_line(tmp_path, text, line):
    file = tmp_path / "answers.py"
    file.write_text(text)
    with pytest.raises(answers.AnswerFileError, match=rf"answers\.py:{line}: .*# %% kind: what"):
        answers.read(file)


SECTIONS = """\
mutants: 40

## no-root (before sign, shaky)
The distance is the root
of the sum.
- a
+ b
+ c
|     d
&- e
&+ f
@ norm
- g
+
= def distance(a, b):
|     return 0
@ above
- 0
+ 1

## not judged: raised
- a
+ 1 / 0

## equivalent
Both are the same.
~ a -> a + 0
"""


def test_mistakes_are_read_with_their_hint_and_their_edits(tmp_path):
    file = tmp_path / "mistakes.txt"
    file.write_text(SECTIONS)
    found = mistakes.read(file)
    whole = "def distance(a, b):\n    return 0"
    assert found.mistakes == (
        mistakes.Mistake(
            "no-root",
            "The distance is the root of the sum.",
            (
                mistakes.Edit("solution", (("a", "b"),)),
                mistakes.Edit("solution", (("a", "c\n    d"), ("e", "f"))),
                mistakes.Edit("norm", (("g", ""),)),
                whole,
                mistakes.Edit("above", (("0", "1"),), whole),
            ),
            ("sign",),
            True,
        ),
    )
    edit = mistakes.Edit("solution", (("a", "1 / 0"),))
    assert found.stumbles == (mistakes.Stumble("raised", (edit,)),)
    assert (found.equivalent, found.mutants) == ({"a -> a + 0": "Both are the same."}, 40)


def test_a_section_edits_the_text_of_the_section_above_if_it_names_none(tmp_path):
    file = tmp_path / "mistakes.txt"
    file.write_text("## a\nA.\n@ norm\n- x\n+ y\n\n## b\nB.\n+ z\n\n## c\nC.\n- x\n+ w\n")
    ways = [mistake.programs for mistake in mistakes.read(file).mistakes]
    changes = ("norm", "y"), ("norm", "z"), ("solution", "w")
    assert ways == [(mistakes.Edit(way, (("x", new),)),) for way, new in changes]


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("- a\n+ b", 1, "begin with a heading"),
        ("## sign\nA hint.", 1, "needs a hint, and a program"),
        ("## sign\n- a\n+ b", 1, "needs a hint, and a program"),
        ("## sign (early)\nA hint.\n= a", 1, "'early' is neither"),
        ("## sign\nA hint.\n+ b", 3, r"needs a line with '-' above"),
        ("## sign\nA hint.\n- a\n+ b\n&+ c", 5, "needs a line with '&-'"),
        ("## sign\nA hint.\n- a\n+ b\nif c:", 5, "a hint stands above the programs"),
        ("## sign\nA hint.\n@ above\n- a\n+ b", 3, "needs a whole program"),
        ("## sign\n| a", 2, "continues code"),
    ],
)
def test_an_error_in_a_file_of_mistakes_is_reported_with_its_line(tmp_path, text, line, message):
    file = tmp_path / "mistakes.txt"
    file.write_text(text)
    with pytest.raises(mistakes.MistakeFileError, match=rf"mistakes\.txt:{line}: .*{message}"):
        mistakes.read(file)
