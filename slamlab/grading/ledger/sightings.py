"""Sightings: in which order the judge first saw what was handed in.

This counter, and no clock, tells which of a student's attempts is the last: a file's time is
anybody's. Those of one run are seen in the order of their names, so that it does not matter in
what order they are graded, on how many machines, or whether a run was broken off.
"""

import hashlib

import sqlalchemy as sa

from slamlab.grading import gradebook_rows

SIGHTINGS = sa.Table(
    "sightings",
    gradebook_rows.TABLES,
    sa.Column("key", sa.String(64), primary_key=True),
    sa.Column("number", sa.Integer, nullable=False, index=True),
    sa.Column("about", sa.String(64), nullable=False, index=True),
)


def sight(connection, found):
    """Give each submission its number, the next ones to those that were not seen before.

    Parameters
    ----------
    connection : sqlalchemy.Connection, in a transaction that writes
    found : list of (name, hash of its content), in the order in which they are seen

    Returns
    -------
    dict, name to number
    """
    known = dict(connection.execute(sa.select(SIGHTINGS.c.key, SIGHTINGS.c.number)).all())
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
        connection.execute(sa.insert(SIGHTINGS), new)
    return numbers


def listed(connection):
    """All sightings as dicts."""
    return [dict(row) for row in connection.execute(sa.select(SIGHTINGS)).mappings()]


def merge(connection, theirs):
    """Bring in sightings of another gradebook; of two numbers the smaller one stays.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    theirs : list of dict
    """
    ours = {row["key"]: row["number"] for row in listed(connection)}
    new = [row for row in theirs if row["key"] not in ours]
    if new:
        connection.execute(sa.insert(SIGHTINGS), new)
    for row in theirs:
        if ours.get(row["key"], 0) > row["number"]:
            mine = SIGHTINGS.c.key == row["key"]
            connection.execute(sa.update(SIGHTINGS).where(mine).values(number=row["number"]))


def forget(connection, names):
    """Delete the sightings of submissions by their names."""
    for name in names:
        connection.execute(sa.delete(SIGHTINGS).where(SIGHTINGS.c.about == _hash(name)))


def _hash(text):
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
