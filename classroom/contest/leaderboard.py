"""The leaderboard of a contest: ranks, tables, and a page for each student.

All files may be published: they do not reveal which student has which pseudonym."""

import re
from collections import Counter
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import numpy as np

from classroom.contest.class_judging import ContestEntry
from classroom.contest.large_errors import DISTANCE, MAX_ERROR, first_large_error
from classroom.contest.pictures import film_page, map_picture
from classroom.contest.ranking import LEVEL, Standing, by_families, standings
from classroom.grading.grade_tables import write_table
from classroom.grading.page_templates import templates
from classroom.grading.records import private_folder, write_atomically
from classroom.grading.tree_removal import remove_tree
from classroom.project.estimate_errors import LENGTHS
from slamlab.views.colours import COLOURS

TEMPLATES = templates(Path(__file__).parent)
BOOTSTRAP_SEED = 0  # fixed, so that the same points give the same ranks


@dataclass(frozen=True)
class Row:
    """A row of the board."""

    name: str  # the shown name: a pseudonym or the student's name
    entry: ContestEntry
    standing: Standing

    @property
    def page(self):
        return f"students/{self.slug}.html"

    @property
    def slug(self):
        """A unique file name without suffix."""
        words = re.findall(r"[a-z0-9]+", self.name.lower())
        if self.name.lower() == " ".join(words):
            return "-".join(words)
        return "-".join([*words, sha256(self.name.encode()).hexdigest()[:8]])


def rank(entries, names, prepared_worlds):
    """Rank the judged entries; return Rows, best first, and the Standings of the baselines.

    names : maps each student to the shown name."""
    judged = [entry for entry in entries if entry.reason is None]
    families = [prepared_world.world.name for prepared_world in prepared_worlds]
    baselines = {
        name: by_families(
            [
                prepared_world.judge(prepared_world.runs[name]).points
                for prepared_world in prepared_worlds
            ],
            families,
        )
        for name in prepared_worlds[0].runs
    }
    tables = [entry.table for entry in judged]
    found, marks = (
        standings(some, np.random.default_rng(BOOTSTRAP_SEED))
        for some in (tables, list(baselines.values()))
    )
    rows = [Row(names[e.student], e, s) for e, s in zip(judged, found, strict=True)]
    rows.sort(key=lambda row: (row.standing.rank, -row.standing.score, row.name))
    return rows, dict(zip(baselines, marks, strict=True))


def write_leaderboard(out, rows, marks, prepared_worlds, contest, unjudged, code=None):
    """Write ``index.html``, ``board.csv``, ``worlds.csv`` and the students' pages.

    rows, marks : results of :func:`rank`. unjudged : pairs (name, reason). code : maps each student
    to the code, or None."""
    families = list(dict.fromkeys(prepared_world.world.name for prepared_world in prepared_worlds))
    known = {"rows": rows, "marks": marks, "families": families, "contest": contest,
             "unjudged": unjudged, "level": LEVEL, "colours": COLOURS}  # fmt: skip
    write_atomically(out / "index.html", TEMPLATES.get_template("leaderboard.html").render(known))
    write_table(out / "board.csv", _board_table(rows, families))
    write_table(out / "worlds.csv", _worlds_table(rows))
    remove_tree(out / "students")  # earlier pages may have had other names
    for row in rows:
        write_student_page(out, row, prepared_worlds, families, (code or {}).get(row.entry.student))


def write_student_page(out, row, prepared_worlds, families, code=None):
    """Write a student's page, and a film of the world with the largest loss.

    Only the median world of each family counts; the film shows the median world with the fewest
    points."""
    results = row.entry.results
    large_errors = [
        None
        if prepared.world.truth is None
        else first_large_error(run.online, prepared.world.truth.poses, prepared.world.metres)
        for run, prepared in zip(row.entry.runs, prepared_worlds, strict=True)
    ]
    numbers = list(_numbers(results))
    counted = {_median([k for k, r in enumerate(results) if r.family == f], results)
               for f in families}  # fmt: skip
    shown = min(sorted(counted), key=lambda k: results[k].points)
    title = f"{results[shown].family}, world {numbers[shown]}"
    recorded = prepared_worlds[shown].world.truth is None
    private_folder(out / "students")
    film = out / "students" / f"{row.slug}-film.html"
    replay = film_page(
        prepared_worlds[shown],
        row.entry.runs[shown],
        f"{row.name}: {title}",
        film.with_suffix(".film"),
    )
    write_atomically(film, replay)
    text = film.with_name(f"{row.slug}-code.txt")
    if code is not None:
        write_atomically(text, code)
    page = TEMPLATES.get_template("student.html").render(
        row=row,
        code=None if code is None else text.name,
        worlds=[
            (result.family, numbers[k], result, large_errors[k], k in counted)
            for k, result in enumerate(results)
        ],
        recorded=recorded,
        title=title,
        picture=map_picture(prepared_worlds[shown], row.entry.runs[shown], large_errors[shown]),
        error=large_errors[shown],
        film=film.name,
        lengths=LENGTHS,
        distance=DISTANCE,
        max_error=MAX_ERROR,
        level=LEVEL,
        colours=COLOURS,
    )
    write_atomically(out / row.page, page)


def _median(which, results):
    return sorted(which, key=lambda k: results[k].points)[len(which) // 2]


def _numbers(results):
    """Yield the number of each world within its family, counted from 1."""
    seen = Counter()
    for result in results:
        seen[result.family] += 1
        yield seen[result.family]


def _board_table(rows, families):
    yield ["rank", "name", "score", "low", "high", *families]
    for row in rows:
        found = row.standing
        numbers = (found.score, found.low, found.high, *found.families)
        yield [str(found.rank), row.name, *(f"{value:.2f}" for value in numbers)]


def _worlds_table(rows):
    errors = [f"error over {length:g} m" for length in LENGTHS]
    more = ["error of relations", "map", "completeness", "nees", "cpu", "late", "mistakes"]
    yield ["name", "sha256", "family", "world", "points", *errors, *more]
    for row in rows:
        results = row.entry.results
        worlds = zip(row.entry.runs, results, _numbers(results), strict=True)
        for run, result, number in worlds:
            found = result.measures
            numbers = (*found.errors, found.relations, found.map, found.completeness, found.nees,
                       run.seconds)  # fmt: skip
            yield [
                row.name, row.entry.sha256, result.family, str(number),
                repr(float(result.points)), *(f"{value:.4g}" for value in numbers),
                str(int(run.late)), " | ".join(run.mistakes),
            ]  # fmt: skip
