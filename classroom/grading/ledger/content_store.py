"""Content-addressed store (table ``contents``): records refer to contents by hash, so that the
chain also protects the contents.
"""

from classroom.grading.database import TABLES, sa
from classroom.grading.ledger import chains
from classroom.grading.ledger.contents import MAX_BYTES

CONTENTS = sa.Table(
    "contents",
    TABLES,
    sa.Column("sha256", sa.String(64), primary_key=True),
    sa.Column("bytes", sa.LargeBinary(MAX_BYTES), nullable=False),
)


def store(connection, kept):
    """Store new contents under their hashes."""
    known = set()
    for some in chains.parts(kept):
        there = sa.select(CONTENTS.c.sha256).where(CONTENTS.c.sha256.in_(some))
        known.update(connection.execute(there).scalars())
    new = [{"sha256": name, "bytes": kept[name]} for name in sorted(set(kept) - known)]
    if new:
        connection.execute(sa.insert(CONTENTS), new)


def load(connection, names):
    """Return the stored contents with the hashes ``names``, as a dict from hash to bytes."""
    found = {}
    for some in chains.parts(set(names)):
        asked = sa.select(CONTENTS).where(CONTENTS.c.sha256.in_(some))
        found |= {row.sha256: row.bytes for row in connection.execute(asked)}
    return found


def drop_unnamed(connection):
    """Delete contents to which no attempt refers."""
    attempts = chains.bodies(connection, "attempt")
    named = {name for body in attempts for name in body["record"].get("kept", {}).values()}
    for sha256 in connection.execute(sa.select(CONTENTS.c.sha256)).scalars().all():
        if sha256 not in named:
            connection.execute(sa.delete(CONTENTS).where(CONTENTS.c.sha256 == sha256))
