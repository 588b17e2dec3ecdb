"""Clues: what can be said of an answer whose mistake has no name, by whatever method it was made.

What came back is compared with what the laws want, number by number: where it is wrong, and how.
A clue states what is so, and asks for the line; it does not guess the line.
"""

import numpy as np

from slamlab.exercises.case_text import UNNAMED
from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.input_sets import MAIN
from slamlab.exercises.law import ROUNDING, TOLERANCE, Mistake, one_judging
from slamlab.exercises.outputs import all_measured
from slamlab.exercises.reading import READINGS
from slamlab.exercises.report import and_others

FEW = 3  # fewer numbers may look alike by chance
NEAR = 0.03  # share of the largest number wanted that is near
SAME = 1e-6  # share by which the same numbers differ from method to method

TURNED = "is off by whole turns, 2π. What is wrapped here, and what should be?"
NEGATIVE = (
    "is exactly the negative of the right one: a sign is turned, or an angle by half a turn. Which "
    "line does it, and for which inputs?"
)
HALF_TURNED = "is off by half turns, π. Which function knows all four quadrants?"
ZERO = (
    "is 0. Which line should have filled it? Or did an array of whole numbers cut off its "
    "fractions?"
)
SCALED = "is {} times the right one: which factor, or which unit?"
SHIFTED = "is off by the same amount: what is added, or left out, once?"
MULTIPLE = "is off by a multiple of {}: what is counted once too often, or not at all?"
LATER = "stands at entry {} or later, counted from 0, and all before it are right. What differs?"
REORDERED = "stands elsewhere: look at the order of rows, columns and entries."
NEAR_BY = (
    "is off by {} of the largest at most: something small is left out, or an approximation stands "
    "where the exact form is asked for (a coarse step, samples, a rounded number, a loop that "
    "stops early)."
)
ONLY_THERE = (
    "Everything else comes out right: it shows only with {}. What is special there? Either a line "
    "does not allow for it, or one is wrong everywhere, which the other inputs do not bring out."
)
ONE_SIDE = (
    "Of the random inputs just those are wrong where {} is {}: which line should treat the two "
    "signs differently, or alike?"
)


def clue(task, sets, answers) -> Mistake | None:
    """What can be said of where and how an answer is wrong.

    Parameters
    ----------
    task : Task
    sets : what ``task.draw`` made
    answers : set's name to outputs or StudentError

    Returns
    -------
    Mistake or None
    """
    found = all_measured(task, sets, answers)
    if isinstance(found[MAIN], StudentError):
        return None
    with np.errstate(all="ignore"), one_judging():
        laws = {law: _broken_on(task, law, sets, found) for law in task.laws}
        clues = [_only_there(laws)]
        if task.id not in READINGS:  # whose arrays are what the function takes and returns
            clues.append(_how(laws, sets, found) or _one_side(laws, sets))
    clues = [clue for clue in clues if clue]
    return Mistake(clues[0][0], " ".join(says for _, says in clues)) if clues else None


def _broken_on(task, law, sets, found):
    """Set's name to (n,) bool, which of its inputs broke a law, for the sets where some did."""
    judged = [name for name in sets if task.judges(law, name)]
    broken = {name: task.broken(law, sets[name], found[name]) for name in judged}
    return {name: rows for name, rows in broken.items() if rows.any()}


def _only_there(laws):
    """Name and sentence of the probes, where nothing else is wrong."""
    names = list(dict.fromkeys(name for broken in laws.values() for name in broken))
    if not names or MAIN in names:
        return None
    return "only there", ONLY_THERE.format(and_others(names))


def _how(laws, sets, found):
    """Name and sentence of how the numbers of an output are wrong, of the first that is plain."""
    wrong = {}  # output to arrays (came back, wanted)
    for law, broken in laws.items():
        for name, rows in broken.items() if law.want else ():
            if isinstance(found[name], StudentError):
                return None
            for output, want in law.want(sets[name]).items():
                got, want = np.atleast_1d(found[name][output]), np.atleast_1d(want)
                if want.dtype.kind not in "fiu" or got.shape != want.shape:
                    return None
                each = rows if rows.size == len(want) else slice(None)
                pairs = zip(got[each].astype(float), want[each].astype(float), strict=True)
                wrong.setdefault(output, []).extend(pairs)
    for output, pairs in wrong.items():
        plain = pairs and _compared(pairs)
        if plain:
            which = "character" if output == "codes" else "number"
            which += "" if output in UNNAMED else f" of {output}"
            return plain[0], f"Every {which} that is wrong {plain[1]}"
    off = max((_off(*pair) for pairs in wrong.values() for pair in pairs), default=np.inf)
    if off > NEAR:
        return None
    return "near", f"Every number that is wrong {NEAR_BY.format(f'{max(100 * off, 1e-4):.1g} %')}"


def _compared(pairs):
    """Name and sentence of what is so of all wrong numbers among arrays (came back, wanted)."""
    wrong = [np.abs(g - w) > ROUNDING + TOLERANCE * np.abs(w).max(initial=0) for g, w in pairs]
    got = np.concatenate([g[at] for (g, _), at in zip(pairs, wrong, strict=True)])
    want = np.concatenate([w[at] for (_, w), at in zip(pairs, wrong, strict=True)])
    turned = _turned(got, want, 2 * np.pi)
    if not turned.all():  # beside others, an angle that is turned once more is right
        got, want = got[~turned], want[~turned]
    if len(got) < FEW:
        return None
    ratio = np.vdot(want, got) / max(np.vdot(want, want), ROUNDING)
    step, later = _step_of(got - want), min(map(_first_wrong, wrong))
    for name, so, says in (
        ("turned", turned.all(), TURNED),
        ("negative", _same(got, -want).all(), NEGATIVE),
        ("half-turned", _turned(got, want, np.pi).all(), HALF_TURNED),
        ("zero", not got.any(), ZERO),
        ("scaled", got.any() and _same(got, ratio * want).all(), SCALED.format(f"{ratio:.6g}")),
        ("shifted", _same(got - want, (got - want)[0]).all(), SHIFTED),
        ("multiple", step >= FEW, MULTIPLE.format(step)),
        ("reordered", all(_reordered(*pair) for pair in pairs), REORDERED),
        ("later", later > 0, LATER.format(later)),
    ):
        if so:
            return name, says
    return None


def _one_side(laws, sets):
    """Name and sentence of an input whose sign tells the rows that are wrong from the others."""
    for rows in (broken[MAIN] for broken in laws.values() if MAIN in broken):
        if not FEW <= rows.sum() <= rows.size - FEW:
            continue
        for name, array in sets[MAIN].items():
            if name.startswith("_") or len(array) != rows.size or array.ndim > 2:
                continue
            for at in np.ndindex(array.shape[1:]):
                column = array[(slice(None), *at)]
                for sign, side in (("negative", column < 0), ("positive", column > 0)):
                    if np.array_equal(side, rows):
                        entry = f"{name}[{', '.join(map(str, at))}]" if at else name
                        return "one side", ONE_SIDE.format(entry, sign)
    return None


def _same(a, b):
    return np.abs(a - b) <= SAME * np.abs(b)


def _turned(got, want, by):
    times = np.rint((got - want) / by)
    return (times != 0) & (np.abs(got - want - times * by) <= SAME)


def _step_of(off):
    """The largest whole number of which all differences are multiples; 1 if they are not whole."""
    whole = np.rint(off)
    return int(np.gcd.reduce(whole.astype(int))) if _same(off, whole).all() else 1


def _first_wrong(wrong):
    """The first entry of an array where something is wrong; 0 of what is no row of entries."""
    rows = wrong.reshape(len(wrong), -1).any(axis=1) if wrong.ndim else np.array([True])
    return int(np.argmax(rows)) if rows.size > FEW else 0


def _off(got, want):
    """The largest error of an array, as a share of the largest number wanted."""
    return np.abs(got - want).max(initial=0) / np.abs(want).max(initial=ROUNDING)


def _reordered(got, want):
    """Whether an array holds just the numbers that are wanted, of which there are some."""
    ordered = _same(np.sort(got, axis=None), np.sort(want, axis=None)).all()
    return bool(ordered and len(np.unique(want)) >= FEW)
