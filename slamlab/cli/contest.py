"""``slamlab contest FOLDER --out DIR``: a class's own SLAMs on worlds that nobody has seen."""

import os
import sys
import tempfile
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from slamlab.cli.common import UsageError, signals_as_interrupt
from slamlab.cli.grade_output import printable


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "contest",
        help="judge a class's own SLAMs on worlds that nobody has seen",
        description=(
            "Judge the notebooks below FOLDER that define a class MySlam, all on the same worlds, "
            "drawn from 256 random bits of the contest's own. Without FOLDER only the commitment "
            "is made: DIR/commitment.txt holds a hash to be told before the hand-in. Writes a "
            "board with tables, a page and a film for each student, into DIR/board, which may be "
            "published, and reveals the bits there; the rest of DIR is for you alone. Started "
            "again, it goes on where it was left."
        ),
    )
    parser.add_argument(
        "folder",
        metavar="FOLDER",
        type=Path,
        nargs="?",
        help="where the submissions are: a folder or a zip",
    )
    parser.add_argument("--out", metavar="DIR", type=Path, required=True, help="for the results")
    parser.add_argument(
        "--names", action="store_true", help="show names instead of pseudonyms; ask the class first"
    )
    parser.add_argument(
        "--open",
        action="store_true",
        help="more may be handed in: the board shows one score of each student, and a new "
        "one only where it is better beyond doubt. Judge without --open to close the contest",
    )
    parser.add_argument(
        "--code",
        action="store_true",
        help="open the code of the notebooks, too, beside the students' pages, as for a second "
        "contest in which all may build on it; ask the class first",
    )
    parser.add_argument(
        "--worlds",
        metavar="N",
        type=int,
        help="worlds of each family (5), when the contest is made; 1 is enough for a rehearsal",
    )
    parser.add_argument(
        "--log",
        metavar="LOG",
        action="append",
        default=[],
        help="a recorded log that is driven, too, and scored by its relations, when the contest is "
        "made: a recording's name, such as intel, or LOG,RELATIONS, two files, which are named "
        "again when it is judged; may be given several times",
    )
    parser.add_argument(
        "--again",
        metavar="DIR",
        type=Path,
        help="judge again a contest that is over: the folder of its board, with revealed.json, "
        "commitment.txt and worlds.csv. What a limit of time had ended is taken from there",
    )
    parser.add_argument(
        "--jobs",
        metavar="N",
        type=int,
        default=os.cpu_count() or 1,
        help="students judged at once; default: one a processor",
    )
    parser.add_argument(
        "--isolation",
        choices=("strict", "basic", "none"),
        default="strict",
        help="sandbox of student code, default strict, as of slamlab grade",
    )
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Judge; 0 when all is written, 2 for wrong use, no sandbox, or a contest that does not fit."""
    # imported late: what a help text needs should come at once
    from slamlab.contest.commitment import ContestError
    from slamlab.files.errors import SourceError
    from slamlab.grading.isolation import IsolationError
    from slamlab.grading.submissions import SubmissionError

    try:
        with tempfile.TemporaryDirectory(prefix="slamlab-zips-") as scratch:
            return _contest(arguments, Path(scratch))
    except (UsageError, ContestError, SubmissionError, SourceError, IsolationError) as error:
        print(f"slamlab contest: {error}", file=sys.stderr)
    except OSError as error:
        print(f"slamlab contest: {error.filename}: {error.strerror}", file=sys.stderr)
    return 2


def _contest(arguments, scratch):
    from slamlab.contest import commitment, contest_logs, holding
    from slamlab.grading import isolation
    from slamlab.grading.term.hand_ins import find_hand_ins
    from slamlab.grading.worker_pool import WorkerPool

    out, again = arguments.out, arguments.again
    if arguments.jobs < 1:
        raise UsageError("--jobs must be at least 1")
    if again and (arguments.folder is None or again.resolve() == out.resolve()):
        raise UsageError("--again needs the FOLDER of the submissions, and another --out")
    if again and arguments.open:
        raise UsageError("--again is for a contest that is over, --open for one that is not")
    if arguments.open and arguments.code:
        raise UsageError("--code is for a contest that closes: leave out --open")
    if arguments.worlds is not None and arguments.worlds < 1:
        raise UsageError("--worlds must be at least 1")
    if again and arguments.worlds is not None:
        raise UsageError("--again judges the worlds that were: leave out --worlds")
    if again:
        contest = holding.contest_again(again)
    else:
        known = (out / commitment.SECRET).exists()
        logs = () if known else contest_logs.hashes_of(arguments.log)
        contest = commitment.commit(out, arguments.worlds, logs)
    if arguments.folder is None:
        file = out / commitment.COMMITMENT
        print(f"{contest.commitment}\ntell this hash before the hand-in; {file} keeps it")
        return 0
    logs = contest_logs.open_logs(contest, arguments.log)
    found = find_hand_ins(arguments.folder, scratch, out)
    isolation.ensure_level(arguments.isolation)
    with signals_as_interrupt(), WorkerPool(arguments.isolation) as workers:
        prepared = _prepared(holding.draw_arenas(contest, logs), contest)
        with _bar() as progress:
            readable = sum(entrant.problem is None for entrant in holding.entrants(found))
            bar = progress.add_task("", total=readable * len(prepared))
            said = holding.hold_contest(
                contest, found, out, prepared, workers, jobs=arguments.jobs,
                names=arguments.names, again=again, stays_open=arguments.open, code=arguments.code,
                told=lambda name: progress.update(bar, advance=1, description=printable(name)),
            )  # fmt: skip
    print("\n".join(map(printable, said)))
    return 0


def _prepared(drawn, contest):
    """The worlds, with a bar while they are drawn and the package's own estimators drive them."""
    prepared = []
    with _bar() as progress:
        bar = progress.add_task("worlds", total=len(contest.places))
        for arena in drawn:
            prepared.append(arena)
            progress.update(bar, advance=1, description=f"worlds: {arena.world.name}")
    return prepared


def _bar():
    columns = (BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    text = TextColumn("{task.description}", markup=False)
    return Progress(*columns, text, console=Console(stderr=True))
