"""Programs of a task as plain code: the file ``answers.py`` in its folder, which is never shipped.

A line ``# %% kind: what it is`` begins a program. The kinds are

way     a right program, whose mutants are fingerprinted as well
pasted  functions of the lesson, adapted to the task; they earn a fifth at most
right   an independent right answer: written from the lesson and the exercise's text alone
wrong   an independent wrong answer, written in the same way
passes  an independent wrong answer that keeps full marks: no law distinguishes it from right ones

An independent answer is kept if it tests something that no other answer tests. Nothing in the
checks may be tuned to a single one of them.
"""

import re
from dataclasses import dataclass

INDEPENDENT = ("right", "wrong", "passes")
KINDS = ("way", "pasted", *INDEPENDENT)
_MARKER = re.compile(r"# %% (\w+): (\S.*)")


class AnswerFileError(Exception):
    """A file of answers has an error: "file:line: what is wrong and what to do"."""


@dataclass(frozen=True)
class Answer:
    """A program of a task.

    Parameters
    ----------
    kind : str, one of :data:`KINDS`
    what : str, what it is, in a few words
    source : str
    """

    kind: str
    what: str
    source: str


def read(path):
    """Read the programs of a file of answers.

    Parameters
    ----------
    path : Path

    Returns
    -------
    list of Answer

    Raises
    ------
    AnswerFileError
    """
    found = []
    for number, line in enumerate(path.read_text("utf-8").splitlines(), 1):
        if line.startswith("# %%"):
            match = _MARKER.fullmatch(line)
            if not match or match[1] not in KINDS:
                raise AnswerFileError(
                    f"{path}:{number}: write '# %% kind: what it is', where the kind is one of "
                    f"{', '.join(KINDS)}"
                )
            found.append((match[1], match[2], []))
        elif found:
            found[-1][2].append(line)
        elif line.strip():
            raise AnswerFileError(f"{path}:{number}: begin with a line '# %% kind: what it is'")
    return [Answer(kind, what, "\n".join(lines).strip("\n")) for kind, what, lines in found]
