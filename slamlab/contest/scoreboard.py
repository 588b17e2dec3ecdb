"""The board of a contest, as static pages and tables: ranks, and a page for each student.

Everything below its folder may be put on a site: nothing in it says whose a pseudonym is.
"""

import re
from collections import Counter
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import jinja2
import numpy as np

from slamlab.contest.class_judging import Entry
from slamlab.contest.moments import BAND, WAY, first_moment
from slamlab.contest.pictures import film_page, map_picture
from slamlab.contest.ranking import LEVEL, Standing, by_families, standings
from slamlab.grading.grade_tables import write_table
from slamlab.grading.records import private_folder, write_atomically
from slamlab.grading.tree_removal import remove_tree
from slamlab.project.drive_errors import LENGTHS
from slamlab.views.colours import COLOURS

TEMPLATES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
BOOTSTRAP_SEED = 0  # so that the same points give the same ranks


@dataclass(frozen=True)
class Row:
    """A row of the board.

    Parameters
    ----------
    name : str, as it is shown: a pseudonym, or the student's own
    entry : Entry
    standing : Standing
    """

    name: str
    entry: Entry
    standing: Standing

    @property
    def page(self):
        """The file of the student's page."""
        return f"students/{self.slug}.html"

    @property
    def slug(self):
        """A file's name, no two alike."""
        words = re.findall(r"[a-z0-9]+", self.name.lower())
        if self.name.lower() == " ".join(words):
            return "-".join(words)
        return "-".join([*words, sha256(self.name.encode()).hexdigest()[:8]])


def rank(entries, names, arenas):
    """Rank those who could be judged.

    Parameters
    ----------
    entries : list of Entry
    names : dict, student to the name shown
    arenas : list of Arena

    Returns
    -------
    list of Row, the best first; dict, baseline's name to its Standing
    """
    judged = [entry for entry in entries if entry.reason is None]
    families = [arena.world.name for arena in arenas]
    baselines = {
        name: by_families([arena.judge(arena.drives[name]).points for arena in arenas], families)
        for name in arenas[0].drives
    }
    tables = [entry.table for entry in judged]
    found, marks = (
        standings(some, np.random.default_rng(BOOTSTRAP_SEED))
        for some in (tables, list(baselines.values()))
    )
    rows = [Row(names[e.student], e, s) for e, s in zip(judged, found, strict=True)]
    rows.sort(key=lambda row: (row.standing.rank, -row.standing.score, row.name))
    return rows, dict(zip(baselines, marks, strict=True))


def write_board(out, rows, marks, arenas, contest, unjudged, code=None):
    """Write ``index.html``, ``board.csv``, ``worlds.csv`` and the students' pages.

    Parameters
    ----------
    out : Path
    rows : list of Row, the best first
    marks : dict, baseline to Standing
    arenas : list of Arena
    contest : Contest
    unjudged : list of (name, reason)
    code : dict or None, student to the code that is opened
    """
    families = list(dict.fromkeys(arena.world.name for arena in arenas))
    known = {"rows": rows, "marks": marks, "families": families, "contest": contest,
             "unjudged": unjudged, "level": LEVEL, "colours": COLOURS}  # fmt: skip
    write_atomically(out / "index.html", TEMPLATES.get_template("scoreboard.html").render(known))
    write_table(out / "board.csv", _board_table(rows, families))
    write_table(out / "worlds.csv", _worlds_table(rows))
    remove_tree(out / "students")  # whose names may have been other ones
    for row in rows:
        write_student_page(out, row, arenas, families, (code or {}).get(row.entry.student))


def write_student_page(out, row, arenas, families, code=None):
    """Write a student's page, and the film of the world that cost most.

    Of each family the world counts whose points are the median; of these worlds the one with the
    fewest points is shown.

    Parameters
    ----------
    out : Path
    row : Row
    arenas : list of Arena
    families : list of str
    code : str or None, the student's, put beside the page as plain text
    """
    results = row.entry.results
    moments = [
        None if arena.world.truth is None
        else first_moment(driven.online, arena.world.truth.poses, arena.world.metres)
        for driven, arena in zip(row.entry.drives, arenas, strict=True)
    ]  # fmt: skip
    numbers = list(_numbers(results))
    counted = {_median([k for k, r in enumerate(results) if r.family == f], results)
               for f in families}  # fmt: skip
    shown = min(sorted(counted), key=lambda k: results[k].points)
    title = f"{results[shown].family}, world {numbers[shown]}"
    recorded = arenas[shown].world.truth is None
    private_folder(out / "students")
    film = out / "students" / f"{row.slug}-film.html"
    replay = film_page(
        arenas[shown], row.entry.drives[shown], f"{row.name}: {title}", film.with_suffix(".film")
    )
    write_atomically(film, replay)
    text = film.with_name(f"{row.slug}-code.txt")
    if code is not None:
        write_atomically(text, code)
    page = TEMPLATES.get_template("student.html").render(
        row=row,
        code=None if code is None else text.name,
        worlds=[
            (result.family, numbers[k], result, moments[k], k in counted)
            for k, result in enumerate(results)
        ],
        recorded=recorded,
        title=title,
        picture=map_picture(arenas[shown], row.entry.drives[shown], moments[shown]),
        moment=moments[shown],
        film=film.name,
        lengths=LENGTHS,
        way=WAY,
        band=BAND,
        level=LEVEL,
        colours=COLOURS,
    )
    write_atomically(out / row.page, page)


def _median(which, results):
    """Which of some worlds has the median of their points."""
    return sorted(which, key=lambda k: results[k].points)[len(which) // 2]


def _numbers(results):
    """The number of each world in its family, from 1."""
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
        worlds = zip(row.entry.drives, results, _numbers(results), strict=True)
        for driven, result, number in worlds:
            found = result.measures
            numbers = (*found.errors, found.relations, found.map, found.completeness, found.nees,
                       driven.seconds)  # fmt: skip
            yield [
                row.name, row.entry.sha256, result.family, str(number),
                repr(float(result.points)), *(f"{value:.4g}" for value in numbers),
                str(int(driven.late)), " | ".join(driven.mistakes),
            ]  # fmt: skip
