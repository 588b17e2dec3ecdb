"""Right ways through each task and the slips on them: programs, never in a student's hands.

A module ``exNN/topic.py`` belongs to ``slamlab/exercises/tasks/exNN/topic.py``. It holds

- ``TASK``, the task's id
- ``WAYS``, name to source: right solutions other than that of ``course/exercises``
- ``SLIPS``, the mistakes that have a name and a hint
- ``STUMBLES``, programs whose answer cannot be judged
- ``PASTED``, name to source: functions of the lesson adapted to the task, worth a fifth at most
- ``MUTANTS``, of a task that takes long: how many mutants of the solution are fingerprinted
- ``EQUIVALENT``, text of a mutation to the reason why it is right as well

A program is an edit of the solution ``("find", "replace")``, a list of such edits, an :class:`Edit`
of another way, or source that defines functions anew.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Edit:
    """An edit of a right way: pairs (find, replace), each of which must be found just once."""

    way: str
    pairs: tuple


class Slip:
    """A mistake with a name: its hint, and the programs that make it.

    Parameters
    ----------
    name : str, short; stands in the record
    hint : str, for the student: what is wrong and what to think of, not the solution
    programs : edits or sources
    before : names of slips that compute the same, over which this one has precedence
    shaky : bool, what it computes hangs on the machine's rounding: it is named where it is
        recognised, and else told by its laws alone
    """

    def __init__(self, name, hint, *programs, before=(), shaky=False):
        self.name, self.hint, self.programs, self.before = name, hint, programs, before
        self.shaky = shaky


class Stumble:
    """Programs whose answer cannot be judged.

    Parameters
    ----------
    kind : str, of the problem: "raised", "malformed", "missing", "not attempted", "time"
    programs : edits or sources
    """

    def __init__(self, kind, *programs):
        self.kind, self.programs = kind, programs
