"""``slamlab contest FOLDER --out DIR``: rank a class's own SLAM programs on hidden worlds."""

import os
import tempfile
from pathlib import Path

from classroom.cli.common import add_isolation_option, answered
from classroom.cli.grade_output import progress_bar
from slamlab.cli.common import FAILED, printable, signals_as_interrupt
from slamlab.cli.parsers import UsageError, add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "contest",
        "Rank a class's own SLAM programs on hidden worlds.",
        "--out autumn",
        "submissions --out autumn --open",
    )
    add = parser.add_argument
    folder = "Folder or zip of the submissions (default: only commit to the worlds' seed)"
    add("folder", metavar="FOLDER", type=Path, nargs="?", help=folder)
    add("--out", metavar="DIR", type=Path, required=True, help="Folder of the contest")
    names = "Show names instead of pseudonyms; ask the class first"
    add("--names", action="store_true", help=names)
    add("--open", action="store_true", help="Keep the contest open for further submissions")
    code = "Also publish the code of the notebooks; ask the class first"
    add("--code", action="store_true", help=code)
    worlds = "Number of worlds of each family in a new contest (default: 5)"
    add("--worlds", metavar="N", type=int, help=worlds)
    log = "Recording (intel) or LOG,RELATIONS to run and score as well; repeatable"
    add("--log", metavar="LOG", action="append", default=[], help=log)
    again = "Board folder of a closed contest; judge on its worlds again"
    add("--again", metavar="DIR", type=Path, help=again)
    jobs = "Number of students judged at once (default: number of processors)"
    add("--jobs", metavar="N", type=int, default=os.cpu_count() or 1, help=jobs)
    add_isolation_option(parser, "strict")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Return 0 if all notebooks were judged, 1 if some were not, 2 if the contest cannot run."""
    # imported late: a help text should come at once
    from classroom.contest.seed_commitment import ContestError
    from classroom.grading.isolation import IsolationError
    from classroom.grading.submissions import SubmissionError
    from slamlab.files import SourceError

    refusals = (UsageError, ContestError, SubmissionError, SourceError, IsolationError)

    def act():
        with tempfile.TemporaryDirectory(prefix="slamlab-zips-") as scratch:
            return _contest(arguments, Path(scratch))

    return answered("contest", refusals, act)


def _contest(arguments, scratch):
    from classroom.contest import contest_logs, contest_run, seed_commitment
    from classroom.grading import isolation
    from classroom.grading.term.zipped_submissions import collect_submissions
    from classroom.grading.worker_pool import WorkerPool

    out, again = arguments.out, arguments.again
    if arguments.jobs < 1:
        raise UsageError("--jobs must be at least 1")
    if again and (arguments.folder is None or again.resolve() == out.resolve()):
        raise UsageError("--again needs the FOLDER of the submissions and a different --out")
    if again and arguments.open:
        raise UsageError("--again is for a closed contest. Leave out --open")
    if arguments.open and arguments.code:
        raise UsageError("--code cannot be used with --open. Leave out --open")
    if arguments.worlds is not None and arguments.worlds < 1:
        raise UsageError("--worlds must be at least 1")
    if again and arguments.worlds is not None:
        raise UsageError("--again uses the same worlds. Leave out --worlds")
    if again:
        contest = contest_run.read_published_contest(again)
    else:
        known = (out / seed_commitment.SECRET).exists()
        logs = () if known else contest_logs.hash_logs(arguments.log)
        contest = seed_commitment.commit(out, arguments.worlds, logs)
    if arguments.folder is None:
        file = out / seed_commitment.COMMITMENT
        print(
            f"{contest.commitment}\nPublish this hash before students submit. {file} contains it."
        )
        return 0
    logs = contest_logs.open_logs(contest, arguments.log)
    found = collect_submissions(arguments.folder, scratch, out)
    isolation.ensure_level(arguments.isolation)
    with signals_as_interrupt(), WorkerPool(arguments.isolation) as workers:
        prepared = _prepared(contest_run.prepare_contest_worlds(contest, logs), contest)
        with progress_bar() as progress:
            last_submissions = contest_run.last_submissions(found)
            readable = sum(entrant.problem is None for entrant in last_submissions)
            bar = progress.add_task("", total=readable * len(prepared))
            lines = contest_run.run_contest(
                contest, found, out, prepared, workers, jobs=arguments.jobs,
                names=arguments.names, again=again, stays_open=arguments.open, code=arguments.code,
                report=lambda name: progress.update(bar, advance=1, description=printable(name)),
            )  # fmt: skip
    print("\n".join(map(printable, lines)))
    return FAILED if readable < len(last_submissions) else 0


def _prepared(drawn, contest):
    prepared = []
    with progress_bar() as progress:
        bar = progress.add_task("worlds", total=len(contest.worlds_in_order))
        for prepared_world in drawn:
            prepared.append(prepared_world)
            progress.update(bar, advance=1, description=f"worlds: {prepared_world.world.name}")
    return prepared
