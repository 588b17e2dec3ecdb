"""Error patterns of answers whose mistake was not recognised by a fingerprint.

Outputs are compared with the expected ones, to find a common factor, an offset, a multiple of 2π …
"""

import numpy as np

from classroom.exercises.case_presentation import PRESENTATIONS
from classroom.exercises.correctness_laws import ROUNDING, TOLERANCE, Mistake, cache_within_judging
from classroom.exercises.failing_case_text import UNNAMED
from classroom.exercises.function_calls import StudentError
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.outputs import all_checked_outputs
from classroom.exercises.verdict_text import name_probes

FEW = 3  # fewer numbers may match a pattern by chance
SURE = 100  # sets of rows for each compared entry: its signs match the wrong rows by chance in 2 %
NEAR = 0.03  # largest error of a "near" answer, relative to the largest expected number
SAME = 1e-6  # relative difference of equal numbers that two methods compute

TURNED = "is off by a multiple of 2π. Which angle is wrapped here, and which one should be?"
TRANSPOSED = (
    "is in the transposed position: the matrix is the transpose of the right one. Which index is "
    "the row?"
)
NEGATIVE = (
    "is exactly the negative of the right one: a sign is wrong, or an angle is off by π. In which "
    "line, and for which inputs?"
)
HALF_TURNED = "is off by a multiple of π. Which function distinguishes all four quadrants?"
ZERO = "is 0. Which line should have set it? Or did an array of integers truncate its values?"
SCALED = "is {} times the right one. Which factor or which unit is wrong?"
SHIFTED = "is off by the same amount. Which constant is added, or missing?"
MULTIPLE = "is off by a multiple of {}. What is counted too often, or not at all?"
LATER = "is at entry {} or later, counted from 0; earlier entries are right. What differs there?"
REORDERED = "is in the wrong position. Check the order of rows, columns and entries."
NEAR_BY = (
    "is off by at most {} of the largest number. A small term is missing, or an approximation "
    "replaces the exact form that is required: a coarse step, samples, a rounded number, or a loop "
    "that stops early."
)
ONLY_THERE = (
    "Your answers are wrong only with {}. What is special in this case? Perhaps no line of your "
    "code handles it, or a wrong line changes the result in this case only."
)
ONE_SIDE = (
    "Your answers to the random inputs are wrong exactly where {} is {}. Which line should treat "
    "the two signs differently, or in the same way?"
)


def describe_error_pattern(task, sets, answers) -> Mistake | None:
    """Describe where and how the answers are wrong, as a Mistake with its hint, or None."""
    found = all_checked_outputs(task, sets, answers)
    if isinstance(found[MAIN], StudentError):
        return None
    with np.errstate(all="ignore"), cache_within_judging():
        laws = {law: _broken_on(task, law, sets, found) for law in task.laws}
        patterns = [_only_there(laws)]
        if task.id not in PRESENTATIONS:  # its arrays are the function's arguments and results
            patterns.append(_how(laws, sets, found) or _one_side(laws, sets))
    patterns = [pattern for pattern in patterns if pattern]
    texts = " ".join(text for _, text in patterns)
    return Mistake(patterns[0][0], texts, asks=None) if patterns else None


def _broken_on(task, law, sets, found):
    """Return the inputs of each set that break a law, (n,) bool by name; omit sets with none."""
    judged = [name for name in sets if task.judges(law, name)]
    broken = {name: task.broken(law, sets[name], found[name]) for name in judged}
    return {name: rows for name, rows in broken.items() if rows.any()}


def _only_there(laws):
    """Return the pattern's name and text if only answers to probes are wrong, otherwise None."""
    names = list(dict.fromkeys(name for broken in laws.values() for name in broken))
    if not names or MAIN in names:
        return None
    return "only there", ONLY_THERE.format(name_probes(names))


def _how(laws, sets, found):
    """Return the name and text of the error pattern of the first output that has one."""
    wrong = {}  # output to pairs of arrays (returned, expected)
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
        pattern = pairs and _compared(pairs)
        if pattern:
            which = "character" if output == "codes" else "number"
            which += "" if output in UNNAMED else f" in {output}"
            return pattern[0], f"Every wrong {which} {pattern[1]}"
    off = max((_off(*pair) for pairs in wrong.values() for pair in pairs), default=np.inf)
    if off > NEAR:
        return None
    return "near", f"Every wrong number {NEAR_BY.format(f'{max(100 * off, 1e-4):.1g} %')}"


def _compared(pairs):
    """Return the name and text of the pattern that all wrong numbers follow."""
    wrong = [np.abs(g - w) > ROUNDING + TOLERANCE * np.abs(w).max(initial=0) for g, w in pairs]
    got = np.concatenate([g[at] for (g, _), at in zip(pairs, wrong, strict=True)])
    want = np.concatenate([w[at] for (_, w), at in zip(pairs, wrong, strict=True)])
    turned = _turned(got, want, 2 * np.pi)
    if not turned.all():  # beside other errors an angle that is off by 2π counts as right
        got, want = got[~turned], want[~turned]
    if len(got) < FEW:
        return None
    ratio = np.vdot(want, got) / max(np.vdot(want, want), ROUNDING)
    step, later = _step_of(got - want), min(map(_first_wrong, wrong))
    flags = np.isin([got, want], (-1, 0, 1)).all()
    far = not flags and got.any() and abs(ratio - 1) > NEAR  # a near ratio may be due to samples
    for name, holds, text in (
        ("turned", turned.all(), TURNED),
        ("transposed", all(_transposed(*pair) for pair in pairs), TRANSPOSED),
        ("negative", not flags and _same(got, -want).all(), NEGATIVE),
        ("half-turned", _turned(got, want, np.pi).all(), HALF_TURNED),
        ("zero", not got.any(), ZERO),
        ("scaled", far and _same(got, ratio * want).all(), SCALED.format(f"{ratio:.6g}")),
        ("shifted", not flags and _same(got - want, (got - want)[0]).all(), SHIFTED),
        ("multiple", step >= FEW, MULTIPLE.format(step)),
        ("reordered", all(_reordered(*pair) for pair in pairs), REORDERED),
        ("later", later > 0, LATER.format(later)),
    ):
        if holds:
            return name, text
    return None


def _one_side(laws, sets):
    """Return the name and text of the pattern if an input's sign identifies the wrong rows."""
    arrays = {name: a for name, a in sets[MAIN].items() if name[0] != "_" and a.ndim <= 2}
    entries = [(name, at) for name, a in arrays.items() for at in np.ndindex(a.shape[1:])]
    for rows in (broken[MAIN] for broken in laws.values() if MAIN in broken):
        if not FEW <= rows.sum() <= rows.size - FEW or 2.0**rows.size < SURE * len(entries):
            continue
        for name, at in entries:
            column = arrays[name][(slice(None), *at)]
            for sign, side in (("negative", column < 0), ("positive", column > 0)):
                if np.array_equal(side, rows):
                    entry = f"{name}[{', '.join(map(str, at))}]" if at else name
                    return "one side", ONE_SIDE.format(entry, sign)
    return None


def _same(a, b):
    return np.abs(a - b) <= SAME * np.abs(b)


def _transposed(got, want):
    return want.ndim == 2 and want.shape[0] == want.shape[1] and _same(got, want.T).all()


def _turned(got, want, by):
    times = np.rint((got - want) / by)
    return (times != 0) & (np.abs(got - want - times * by) <= SAME)


def _step_of(off):
    """Return the greatest common divisor of differences, or 1 if they are not integers."""
    whole = np.rint(off)
    return int(np.gcd.reduce(whole.astype(int))) if _same(off, whole).all() else 1


def _first_wrong(wrong):
    """Return the index of the first wrong entry of an array; 0 for a scalar or a short array."""
    rows = wrong.reshape(len(wrong), -1).any(axis=1) if wrong.ndim else np.array([True])
    return int(np.argmax(rows)) if rows.size > FEW else 0


def _off(got, want):
    return np.abs(got - want).max(initial=0) / np.abs(want).max(initial=ROUNDING)


def _reordered(got, want):
    ordered = _same(np.sort(got, axis=None), np.sort(want, axis=None)).all()
    return bool(ordered and len(np.unique(want)) >= FEW)
