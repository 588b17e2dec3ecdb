"""Hash chains of the ledger: append-only rows, each with the hash of the previous row. A gradebook
writes one chain; merging adds chains of other gradebooks. A row's hash covers only a salted hash of
its body, so that the body can be deleted when a student's data are erased.
"""

import hashlib
import json
import secrets
from dataclasses import dataclass, field
from functools import cached_property

from classroom.grading import gradebook_rows
from classroom.grading.database import LONG_TEXT, TABLES, sa

LEDGER = sa.Table(
    "ledger",
    TABLES,
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
"""The order of rows: a row follows all rows that its gradebook contained when the row was written.
Rows that two gradebooks wrote before a merge are ordered by time."""
HASHED = ("chain", "number", "previous", "kind", "at", "latest", "turn", "who", "digest")
MAX_QUERY_VALUES = 500  # values
NO_PREVIOUS = "0" * 64
"""The previous hash of a chain's first row."""


@dataclass(frozen=True)
class Entry:
    """The content of a new row."""

    kind: str  # such as "attempt" or "override"
    body: dict  # plain values
    submission: str | None = None  # to which it refers
    at: str | None = None  # ISO 8601; None for now
    salt: str = field(default_factory=lambda: secrets.token_hex(16))

    @cached_property
    def text(self):
        return canonical(self.body)


def canonical(body):
    """Return plain values as canonical JSON."""
    return json.dumps(body, sort_keys=True, separators=(",", ":"))


def digest(salt, text):
    """Return the salted hash of a body; the salt prevents finding the body by trying names."""
    return hashlib.sha256(f"{salt}{text}".encode()).hexdigest()


def row_hash(row):
    """Return the hash of a row; it covers the body's digest in place of the body."""
    return hashlib.sha256(canonical([row[name] for name in HASHED]).encode()).hexdigest()


def loaded(row):
    """Return a row's body, or None if it was erased."""
    return None if row["body"] is None else json.loads(row["body"])


def about(submission):
    """Return the key by which a submission's rows are found."""
    return submission and hashlib.sha256(submission.encode()).hexdigest()


def append(connection, entries, who):
    """Append rows to the gradebook's own chain, except rows whose salted hash is already stored."""
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
    """Return the last row of the gradebook's own chain (the chain started first), or None."""
    first = connection.execute(sa.select(LEDGER.c.chain).order_by(LEDGER.c.id).limit(1)).scalar()
    mine = sa.select(LEDGER).where(LEDGER.c.chain == first).order_by(LEDGER.c.number.desc())
    found = connection.execute(mine.limit(1)).mappings().first()
    return dict(found) if found else None


def rows(connection, *conditions):
    """Return rows in order, as dicts."""
    found = connection.execute(sa.select(LEDGER).where(*conditions).order_by(*IN_ORDER))
    return [dict(row) for row in found.mappings()]


def bodies(connection, kind, *conditions):
    """Return the bodies of all rows of a kind, in order, except erased ones."""
    wanted = sa.select(LEDGER.c.body).where(LEDGER.c.kind == kind, LEDGER.c.body.is_not(None))
    found = connection.execute(wanted.where(*conditions).order_by(*IN_ORDER))
    return [json.loads(body) for body in found.scalars()]


def bodies_of(connection, kind, submissions):
    """Return the results of :func:`bodies` by submission."""
    found = {}
    for some in parts([about(submission) for submission in submissions]):
        for body in bodies(connection, kind, LEDGER.c.about.in_(some)):
            found.setdefault(body["submission"], []).append(body)
    return found


def parts(values):
    """Split values into lists, each short enough for one query."""
    values = sorted(values)
    return [values[k : k + MAX_QUERY_VALUES] for k in range(0, len(values), MAX_QUERY_VALUES)]


def _begin(connection, who):
    """Start a chain with a random name, which copies of the gradebook keep."""
    at = gradebook_rows.timestamp()
    row = dict.fromkeys(("at", "latest"), at) | {"number": 0, "turn": 0, "previous": NO_PREVIOUS}
    entry = Entry("begin", {})
    row |= {"chain": secrets.token_hex(8), "kind": entry.kind, "who": who}
    row |= {"salt": entry.salt, "body": entry.text, "digest": digest(entry.salt, entry.text)}
    row |= {"hash": row_hash(row), "about": None}
    connection.execute(sa.insert(LEDGER).values(row))
    return row


def _known(connection, digests):
    found = set()
    for some in parts(digests):
        there = sa.select(LEDGER.c.digest).where(LEDGER.c.digest.in_(some))
        found.update(connection.execute(there).scalars())
    return found
