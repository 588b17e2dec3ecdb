"""Say of independent answers how the checks take them: named, led, silent or passed.

*Passed*: full marks. *Unjudged*: told why nothing could be judged. *Named*: a slip's hint. *Led*:
the hint of a family, *property*: of a property, *clue*: where or how it is wrong. *Shown*: no hint,
but a case with what came back. *Silent*: nothing.
"""

import argparse
import json
import warnings
from collections import Counter

from course.programs import namespace, programs
from slamlab.exercises.families import FAMILIES
from slamlab.exercises.run_task import run_and_tell
from slamlab.exercises.task import IDLE
from slamlab.exercises.time_limit import TimeLimitExceeded, capture_output, time_limit
from tests.answers import IDS, answers


def told(one, source):
    """What a student is told of an answer.

    Parameters
    ----------
    one : Programs
    source : str

    Returns
    -------
    Verdict
    """
    limit = time_limit(one.task.drive.seconds, cpu=True)  # a busy machine makes no answer wrong
    try:
        with capture_output(), warnings.catch_warnings(action="ignore"), limit:
            names = namespace(one.exercise.id, source)
            return run_and_tell(one.task, names)
    except TimeLimitExceeded:
        return one.task.failed("time", "still running")
    except Exception as error:
        return one.task.failed("raised", f"the cell itself: {type(error).__name__}: {error}")


def kind(one, verdict) -> str:
    """How a wrong answer was taken."""
    if verdict.full:
        return "passed"
    if verdict.problem:
        return "unjudged"
    changed = [law.name for law in verdict.laws if law.failed] == ["unchanged"]
    if changed or verdict.diagnosis in {slip.name for slip in one.slips}:
        return "named"
    if verdict.diagnosis in FAMILIES:
        return "led"
    if verdict.diagnosis:
        properties = {IDLE.name, *(found.name for found in one.task.diagnoses)}
        return "property" if verdict.diagnosis in properties else "clue"
    return "shown" if verdict.case else "silent"


def main():
    """Print a table of exercises and, where asked, every answer with what was said of it."""
    parser = argparse.ArgumentParser(prog="python -m tests.answers", description=__doc__)
    parser.add_argument("exercise", nargs="*", help="such as 06; default: all there are")
    parser.add_argument("--all", action="store_true", help="every answer, as a line of JSON")
    arguments = parser.parse_args()
    for id in arguments.exercise or IDS:
        right, wrong = answers(id)
        of = {one.task.id: one for one in programs(id)}
        lost = [(t, what) for t, what, source in right if not told(of[t], source).full]
        counts = Counter()
        for task, what, source in wrong:
            verdict = told(of[task], source)
            counts[kind(of[task], verdict)] += 1
            if arguments.all:
                said = verdict.problem or f"{verdict.diagnosis}: {verdict.hint}"
                line = task, kind(of[task], verdict), verdict.points, what, said
                print(json.dumps(line, ensure_ascii=False))
        print(f"{id}: {len(wrong)} wrong: {dict(counts)}; {len(right)} right", end="")
        print(f", of which lose points: {lost}" if lost else ", none loses points")


if __name__ == "__main__":
    main()
