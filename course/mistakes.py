"""The wrong programs of a task, which are never shipped: the file ``mistakes.txt`` in its folder.

The file is a list of sections. Each begins with a heading, followed by text and programs::

    ? S and K: Which errors does the innovation contain? Does your line contain each of them once?

    ## only-robot (before sign, shaky)
    ? Which estimates have errors that are correlated with the error of the pose?
    P_nr is right, but P_ni is zero. The new landmark is correlated with every landmark
    that the pose is correlated with.
    - row = Jxr @ P[:3]
    + row = np.pad(Jxr @ P[:3, :3], ((0, 0), (0, len(x) - 3)))

A heading names a mistake, and the text below it is its hint. ``before`` names a mistake with the
same results, over which this one has precedence. The results of a ``shaky`` mistake depend on
rounding. Two other headings exist: ``## not judged: raised`` (the kind of a problem) lists programs
whose answer cannot be judged. ``## equivalent`` gives the reason why mutants of a right program are
right as well.

A mistake is first answered by a question. Above the first heading, a question belongs to a quantity
that a line of the solution computes (:mod:`course.quantities`): to ``S``, ``v[1]``, ``result``,
``result 2``, ``if`` or ``for``. It is asked for every mistake in this quantity, named or not. A
question in a section is asked for this mistake alone.

The first character of a line states what it contains:

====== ===========================================================================================
``-``   a text of the solution, which must occur there once; without it, ``+`` replaces the text
        that the section above replaces
``+``   the text in its place; each ``+`` is a program of its own
``&-``  another text to find, and ``&+`` its replacement, in the program above
``=``   a whole program
``@``   the program that the following lines edit instead of the solution: the name of another right
        program, or ``above`` for the last whole program of this section
``?``   a question; above the first heading ``? S: …`` or ``? S and K: …``
``~``   the text of a mutation, such as ``a -> b``, below ``## equivalent``
``|``   the next line of a text that takes several lines
====== ===========================================================================================

``mutants: 40`` in the first line limits how many mutants of the solution are fingerprinted.
"""

import re
from dataclasses import dataclass, field, replace

SOLUTION = "solution"
"""Name of the right program in the exercise's notebook."""

ABOVE = "above"

_MARK = re.compile(r"(##|&-|&\+|[-+=@~|?])(?: (.*)|$)", re.DOTALL)
_HEADING = re.compile(r"(?P<name>[^()]+?)(?: \((?P<flags>.*)\))?$")


class MistakeFileError(Exception):
    """A file of mistakes has an error: "file:line: what is wrong and what to do"."""


@dataclass(frozen=True)
class Edit:
    """An edit of a program: pairs (find, replace), each of which must be found just once.

    Parameters
    ----------
    way : str, name of the right program, or :data:`ABOVE`
    pairs : tuple of pairs of str
    above : str or None, the source of the program that is edited, if it is no right one
    """

    way: str
    pairs: tuple
    above: str | None = None


@dataclass(frozen=True)
class Mistake:
    """A mistake with a name: its hint, and the programs that make it.

    Parameters
    ----------
    name : str, short; stands in the record
    hint : str, for the student: what is wrong and what to think of, not the solution
    programs : tuple of Edit or str, the source of a whole program
    before : names of mistakes that compute the same, over which this one has precedence
    shaky : bool, its results depend on the machine's rounding: it is named where it is recognised
    asks : str, the question of this mistake, or ""
    """

    name: str
    hint: str
    programs: tuple
    before: tuple = ()
    shaky: bool = False
    asks: str = ""


@dataclass(frozen=True)
class Stumble:
    """Programs whose answer cannot be judged.

    Parameters
    ----------
    kind : str, of the problem: "raised", "malformed", "missing", "not attempted", "time"
    programs : tuple of Edit or str
    """

    kind: str
    programs: tuple


@dataclass(frozen=True)
class MistakeFile:
    """The content of a file of mistakes.

    Parameters
    ----------
    mistakes : tuple of Mistake, in order of precedence
    stumbles : tuple of Stumble
    equivalent : dict, text of a mutation to the reason why it is right as well
    mutants : int or None, how many mutants of the solution are fingerprinted
    questions : dict, quantity to its question
    """

    mistakes: tuple
    stumbles: tuple
    equivalent: dict
    mutants: int | None
    questions: dict = field(default_factory=dict)


@dataclass
class _Section:
    line: int
    heading: str
    asks: str = ""
    text: list = field(default_factory=list)
    programs: list = field(default_factory=list)
    mutations: list = field(default_factory=list)


def read(path):
    """Read a file of mistakes.

    Parameters
    ----------
    path : Path

    Returns
    -------
    MistakeFile

    Raises
    ------
    MistakeFileError
    """
    lines = path.read_text("utf-8").split("\n")
    mutants = None
    if match := re.fullmatch(r"mutants: (\d+)", lines[0]):
        mutants, lines[0] = int(match[1]), ""
    mistakes, stumbles, equivalent, questions = [], [], {}, {}
    for section in _sections(path, lines, questions):
        hint = " ".join(section.text)
        if section.heading == "equivalent":
            equivalent |= dict.fromkeys(section.mutations, hint)
        elif section.heading.startswith("not judged: "):
            kind = section.heading.removeprefix("not judged: ")
            stumbles.append(Stumble(kind, tuple(section.programs)))
        else:
            mistakes.append(_mistake(path, section, hint))
    return MistakeFile(tuple(mistakes), tuple(stumbles), equivalent, mutants, questions)


def _mistake(path, section, hint):
    name, flags = _HEADING.fullmatch(section.heading).group("name", "flags")
    flags = flags.split(", ") if flags else []
    unknown = [flag for flag in flags if flag != "shaky" and not flag.startswith("before ")]
    if unknown:
        raise _error(path, section.line, f"{unknown[0]!r} is neither 'shaky' nor 'before NAME'")
    if not hint or not section.programs:
        raise _error(path, section.line, "a mistake needs a hint, and a program that makes it")
    before = tuple(flag.removeprefix("before ") for flag in flags if flag != "shaky")
    return Mistake(name, hint, tuple(section.programs), before, "shaky" in flags, section.asks)


def _sections(path, lines, questions):
    sections, reader = [], None
    for number, mark, text in _entries(path, lines):
        if mark == "##":
            sections.append(_Section(number, text))
            reader = _Programs(sections[-1].programs, reader)
        elif mark == "?" and not sections:
            names, colon, asks = text.partition(": ")
            if not colon:
                raise _error(path, number, "name the quantity: '? S: Which …'")
            questions |= dict.fromkeys(names.split(" and "), " ".join(asks.split()))
        elif mark == "?":
            sections[-1].asks = " ".join(text.split())
        elif not sections:
            raise _error(path, number, "begin with a heading such as '## sign', or a question")
        elif mark == "~":
            sections[-1].mutations.append(text)
        elif mark:
            if problem := reader.add(mark, text):
                raise _error(path, number, problem)
        elif sections[-1].programs or sections[-1].mutations:
            raise _error(path, number, "a hint stands above the programs; code needs a mark")
        else:
            sections[-1].text.append(text)
    return sections


class _Programs:
    """Appends the programs of a section to a list, line by line."""

    def __init__(self, programs, above):
        self.programs = programs
        self.way, self.whole, self.find, self.also = SOLUTION, None, None, None
        self._named = False  # whether '@' names the program
        if above and above.way != ABOVE:
            self.way, self.find = above.way, above.find

    def add(self, mark, text):
        """Take a line's mark and text; return what is wrong with it, or None."""
        if mark == "@":
            self.way, self.find, self._named = text, None, True
            if text == ABOVE and self.whole is None:
                return "'@ above' needs a whole program ('=') above it in this section"
        elif mark == "=":
            self.whole = text
            self.programs.append(text)
        elif mark == "-":
            self.way, self.find = self.way if self._named else SOLUTION, text
        elif mark == "&-":
            self.also = text
        elif mark == "+" and self.find is not None:
            above = self.whole if self.way == ABOVE else None
            self.programs.append(Edit(self.way, ((self.find, text),), above))
        elif mark == "&+" and self.also is not None and isinstance(self.programs[-1], Edit):
            last = self.programs[-1]
            self.programs[-1] = replace(last, pairs=(*last.pairs, (self.also, text)))
            self.also = None
        else:
            return f"{mark!r} needs a line with {mark.replace('+', '-')!r} above it"
        return None


def _entries(path, lines):
    """Yield (line's number, mark, text) with the lines that continue a text joined to it."""
    entry = None
    for number, line in enumerate(lines, 1):
        match = _MARK.fullmatch(line)
        mark, text = (match[1], match[2] or "") if match else ("", line)
        if mark == "|":
            if entry is None or entry[1] in ("", "##", "@"):
                raise _error(path, number, "'|' continues code: no line with code is above it")
            entry[2] += "\n" + text
            continue
        if entry:
            yield tuple(entry)
        entry = [number, mark, text] if mark or text.strip() else None
    if entry:
        yield tuple(entry)


def _error(path, line, message):
    return MistakeFileError(f"{path}:{line}: {message}")
