"""Commands of ``slamlab`` for classes, added by an entry point; each command is a module.

Read in this order: ``progress``, ``reset`` (and update), ``check``, ``lesson_recordings``;
``rehearse``, ``print_handout``; ``grade``, ``grade_output``, ``take``, ``term_commands`` (init,
release), ``gradebook_commands`` (merge, adjust, export), ``ledger_commands`` (rejudge, verify,
forget), ``review``, ``similarity``, ``lti``; ``contest``; ``collect``; ``common``: shared
options."""

from slamlab.cli.groups import Group


def _group(title, *names):
    return Group(title, tuple(f"classroom.cli.{name}" for name in names))


GRADING = (
    "grade",
    "take",
    "term_commands",
    "gradebook_commands",
    "ledger_commands",
    "review",
    "similarity",
    "lti",
)
GROUPS = (
    _group("Students", "check", "progress", "reset", "lesson_recordings"),
    _group("Lecturers", "rehearse", "print_handout"),
    _group("Graders", *GRADING, "contest", "collect"),
)
