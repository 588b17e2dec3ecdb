"""Chains of the ledger: rows that are only ever appended, each with the hash of the one before.

A gradebook writes one chain; merging brings in those of others. What a row says, its body, is
bound by a salted hash, so that it can be deleted for a student's sake and the chain still holds.
"""

import hashlib
import json
import secrets
from dataclasses import dataclass, field
from functools import cached_property

import sqlalchemy as sa
from sqlalchemy.dialects import mysql

from slamlab.grading import gradebook_rows

LONG_TEXT = sa.Text().with_variant(mysql.MEDIUMTEXT(), "mysql", "mariadb")
LEDGER = sa.Table(
    "ledger",
    gradebook_rows.TABLES,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("chain", sa.String(32), nullable=False),
    sa.Column("number", sa.Integer, nullable=False),
    sa.Column("previous", sa.String(64), nullable=False),
    sa.Column("kind", sa.String(16), nullable=False),
    sa.Column("at", sa.String(32), nullable=False),
    sa.Column("latest", sa.String(32), nullable=False),
    sa.Column("turn", sa.Integer, nullable=False, index=True),
    sa.Column("who", sa.String(200), nullable=False),
    sa.Column("digest", sa.String(64), nullable=False, index=True),
    sa.Column("hash", sa.String(64), nullable=False),
    sa.Column("salt", sa.String(32)),
    sa.Column("body", LONG_TEXT),
    sa.Column("about", sa.String(64), index=True),
    sa.UniqueConstraint("chain", "number"),
)
IN_ORDER = (LEDGER.c.latest, LEDGER.c.turn, LEDGER.c.chain, LEDGER.c.number)
"""The order of rows: each after all that its gradebook held when it was written; between rows of
two gradebooks that knew nothing of each other it is the clocks that tell."""
HASHED = ("chain", "number", "previous", "kind", "at", "latest", "turn", "who", "digest")
MOST_IN_QUERY = 500  # values
NOTHING = "0" * 64
"""What stands for the row before the first."""


@dataclass(frozen=True)
class Entry:
    """What a row is to say.

    Parameters
    ----------
    kind : str, such as "attempt" or "override"
    body : dict of plain values
    submission : str or None, which it is about
    at : str or None, when (ISO 8601); None for now
    """

    kind: str
    body: dict
    submission: str | None = None
    at: str | None = None
    salt: str = field(default_factory=lambda: secrets.token_hex(16))

    @cached_property
    def text(self):
        """The body as it is stored."""
        return canonical(self.body)


def canonical(body):
    """Plain values as JSON in one form."""
    return json.dumps(body, sort_keys=True, separators=(",", ":"))


def digest(salt, text):
    """The hash of a body; salted, so that nobody finds it by trying names."""
    return hashlib.sha256(f"{salt}{text}".encode()).hexdigest()


def row_hash(row):
    """The hash of a row: of all of it but its body, for which its digest stands."""
    return hashlib.sha256(canonical([row[name] for name in HASHED]).encode()).hexdigest()


def loaded(row):
    """What a row says; None where it was forgotten."""
    return None if row["body"] is None else json.loads(row["body"])


def about(submission):
    """By what the rows of a submission are found."""
    return submission and hashlib.sha256(submission.encode()).hexdigest()


def append(connection, entries, who):
    """Append rows to the gradebook's own chain, within a transaction that writes.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    entries : list of Entry; those that are there already, by their salted hash, are left out
    who : str, who acts
    """
    last = own_head(connection)
    if last is None:
        last = _begin(connection, who)
    highest = sa.select(sa.func.max(LEDGER.c.turn), sa.func.max(LEDGER.c.latest))
    turn, latest = connection.execute(highest).one()
    digests = [digest(entry.salt, entry.text) for entry in entries]
    known, rows = _known(connection, digests), []
    for entry, bound in zip(entries, digests, strict=True):
        if bound in known:
            continue
        at = entry.at or gradebook_rows.timestamp()
        turn, latest = turn + 1, max(at, latest)
        row = {
            "chain": last["chain"],
            "number": last["number"] + 1,
            "previous": last["hash"],
            "kind": entry.kind,
            "at": at,
            "latest": latest,
            "turn": turn,
            "who": who,
            "digest": bound,
        }
        row |= {"hash": row_hash(row), "salt": entry.salt, "body": entry.text}
        rows.append(row | {"about": about(entry.submission)})
        last = row
    if rows:
        connection.execute(sa.insert(LEDGER), rows)


def own_head(connection):
    """The last row of the gradebook's own chain, the one that was begun first; None for none."""
    first = connection.execute(sa.select(LEDGER.c.chain).order_by(LEDGER.c.id).limit(1)).scalar()
    mine = sa.select(LEDGER).where(LEDGER.c.chain == first).order_by(LEDGER.c.number.desc())
    found = connection.execute(mine.limit(1)).mappings().first()
    return dict(found) if found else None


def rows(connection, *conditions):
    """Rows in order, as dicts.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    conditions : of SQLAlchemy

    Returns
    -------
    list of dict
    """
    found = connection.execute(sa.select(LEDGER).where(*conditions).order_by(*IN_ORDER))
    return [dict(row) for row in found.mappings()]


def bodies(connection, kind, *conditions):
    """What the rows of a kind say, in order; those that were forgotten are left out.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    kind : str
    conditions : of SQLAlchemy

    Returns
    -------
    list of dict
    """
    told = sa.select(LEDGER.c.body).where(LEDGER.c.kind == kind, LEDGER.c.body.is_not(None))
    found = connection.execute(told.where(*conditions).order_by(*IN_ORDER))
    return [json.loads(body) for body in found.scalars()]


def bodies_of(connection, kind, submissions):
    """As :func:`bodies`, of some submissions only.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    kind : str
    submissions : set of str

    Returns
    -------
    dict, submission to list of dict
    """
    found = {}
    for some in parts([about(submission) for submission in submissions]):
        for body in bodies(connection, kind, LEDGER.c.about.in_(some)):
            found.setdefault(body["submission"], []).append(body)
    return found


def parts(values):
    """Values, some at a time: databases bound how many a query may hold."""
    values = sorted(values)
    return [values[k : k + MOST_IN_QUERY] for k in range(0, len(values), MOST_IN_QUERY)]


def _begin(connection, who):
    """The first row: a chain has a name of its own, wherever its gradebook is copied to."""
    at = gradebook_rows.timestamp()
    row = dict.fromkeys(("at", "latest"), at) | {"number": 0, "turn": 0, "previous": NOTHING}
    entry = Entry("begin", {})
    row |= {"chain": secrets.token_hex(8), "kind": entry.kind, "who": who}
    row |= {"salt": entry.salt, "body": entry.text, "digest": digest(entry.salt, entry.text)}
    row |= {"hash": row_hash(row), "about": None}
    connection.execute(sa.insert(LEDGER).values(row))
    return row


def _known(connection, digests):
    """Those of some salted hashes that stand in the ledger."""
    found = set()
    for some in parts(digests):
        there = sa.select(LEDGER.c.digest).where(LEDGER.c.digest.in_(some))
        found.update(connection.execute(there).scalars())
    return found
