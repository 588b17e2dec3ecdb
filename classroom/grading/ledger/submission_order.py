"""Order of submissions: the judge numbers submissions when it first reads them. The numbers decide
which attempt is the last, because students can change a file's time. Submissions of one run are
numbered in the order of their names, independently of machines and interruptions.
"""

import hashlib

from classroom.grading.database import TABLES, sa

SUBMISSION_ORDER = sa.Table(
    "sightings",
    TABLES,
    sa.Column("key", sa.String(64), primary_key=True),
    sa.Column("number", sa.Integer, nullable=False, index=True),
    sa.Column("about", sa.String(64), nullable=False, index=True),
)


def number_submissions(connection, found):
    """Return a dict from name to number for submissions, given as (name, hash of content). New
    submissions get the next numbers.
    """
    known = dict(
        connection.execute(sa.select(SUBMISSION_ORDER.c.key, SUBMISSION_ORDER.c.number)).all()
    )
    highest = max(known.values(), default=0)
    numbers, new = {}, []
    for name, content in found:
        about = _hash(name)
        key = _hash(f"{about} {content}")
        if key not in known:
            highest += 1
            known[key] = highest
            new.append({"key": key, "number": highest, "about": about})
        numbers[name] = known[key]
    if new:
        connection.execute(sa.insert(SUBMISSION_ORDER), new)
    return numbers


def listed(connection):
    return [dict(row) for row in connection.execute(sa.select(SUBMISSION_ORDER)).mappings()]


def merge(connection, theirs):
    """Add another gradebook's numbers; if both gradebooks number a submission, keep the smaller
    number.
    """
    ours = {row["key"]: row["number"] for row in listed(connection)}
    new = [row for row in theirs if row["key"] not in ours]
    if new:
        connection.execute(sa.insert(SUBMISSION_ORDER), new)
    for row in theirs:
        if ours.get(row["key"], 0) > row["number"]:
            mine = SUBMISSION_ORDER.c.key == row["key"]
            connection.execute(sa.update(SUBMISSION_ORDER).where(mine).values(number=row["number"]))


def forget(connection, names):
    for name in names:
        connection.execute(
            sa.delete(SUBMISSION_ORDER).where(SUBMISSION_ORDER.c.about == _hash(name))
        )


def _hash(text):
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
