"""A bank of wrong and of alternative right solutions, which proves the tasks.

A module ``exNN.py`` beside this file holds, for exercise NN, ``WRONG``, a list of :class:`Wrong`,
and ``RIGHT``, a list of :class:`Right`. It may hold ``BASE``, Python source that defines right
versions of all functions of all tasks; without it the derived ``solutions/NN_….ipynb`` is the base.
The code of an entry runs after the base in the same namespace, so it says only what differs.

``python -m tests.bank 04 --seeds 1000`` prints how often each entry came out as it should.
"""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Wrong:
    """A wrong solution, what it must lose, and which mistake must be recognised.

    Parameters
    ----------
    name : str, a few words
    code : str, Python source of the functions that differ from the base
    loses : what it must lose, no more and no less: names of laws (of tasks one of whose functions
        the code defines), "task-id:law" for a law of one task, or a task's id for all its laws.
        What is lost because another task needs it is added by itself.
    diagnosis : name of the diagnosis that must be given; None: none may be given
    problem : kind of problem instead of laws: "malformed", "raised", "missing", "not attempted"
    may_lose : "task-id:law" of laws that break or hold by the luck of the inputs
    """

    name: str
    code: str
    loses: frozenset | set | tuple
    diagnosis: str | None = None
    problem: str | None = None
    may_lose: frozenset | set | tuple = ()


@dataclass(frozen=True)
class Right:
    """An alternative right solution, which must lose nothing.

    Parameters
    ----------
    name : str, a few words
    code : str, Python source of the functions that differ from the base
    """

    name: str
    code: str
    loses: frozenset = field(default=frozenset(), init=False)
    diagnosis: None = field(default=None, init=False)
    problem: None = field(default=None, init=False)
    may_lose: frozenset = field(default=frozenset(), init=False)
