"""Contents: the cells of notebooks and the outputs of workers, compressed, by their hashes.

A record names what is kept of it, and so binds it into its chain.
"""

import hashlib
import zlib

import sqlalchemy as sa

from slamlab.grading import gradebook_rows
from slamlab.grading.ledger import chains

MOST = 50_000  # of an attempt's cells, and of its outputs [bytes]; more is not kept
MOST_UNPACKED = 64 << 20  # [bytes]
CONTENTS = sa.Table(
    "contents",
    gradebook_rows.TABLES,
    sa.Column("sha256", sa.String(64), primary_key=True),
    sa.Column("bytes", sa.LargeBinary(MOST), nullable=False),
)


class ContentError(Exception):
    """What is kept is not what a record names."""


def packed(data):
    """Bytes as they are kept; None where they are too many to be.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    bytes or None
    """
    kept = zlib.compress(data, 9) if len(data) <= MOST_UNPACKED else b""
    return kept if 0 < len(kept) <= MOST else None


def unpacked(kept):
    """The bytes that :func:`packed` made smaller.

    Raises
    ------
    ContentError
    """
    try:
        data = zlib.decompressobj()
        found = data.decompress(kept, MOST_UNPACKED + 1)
    except zlib.error as error:
        raise ContentError(f"what is kept is damaged: {error}") from None
    if len(found) > MOST_UNPACKED or not data.eof:
        raise ContentError("what is kept is longer than anything that is")
    return found


def name_of(kept):
    """The hash by which something is kept."""
    return hashlib.sha256(kept).hexdigest()


def store(connection, kept):
    """Store contents that are not there yet.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    kept : dict, hash to bytes
    """
    known = set()
    for some in chains.parts(kept):
        there = sa.select(CONTENTS.c.sha256).where(CONTENTS.c.sha256.in_(some))
        known.update(connection.execute(there).scalars())
    new = [{"sha256": name, "bytes": kept[name]} for name in sorted(set(kept) - known)]
    if new:
        connection.execute(sa.insert(CONTENTS), new)


def load(connection, names):
    """Contents by their hashes; those that are not there are left out.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    names : iterable of str

    Returns
    -------
    dict, hash to bytes
    """
    found = {}
    for some in chains.parts(set(names)):
        asked = sa.select(CONTENTS).where(CONTENTS.c.sha256.in_(some))
        found |= {row.sha256: row.bytes for row in connection.execute(asked)}
    return found


def drop_unnamed(connection):
    """Delete what no attempt names any more."""
    told = chains.bodies(connection, "attempt")
    named = {name for body in told for name in body["record"].get("kept", {}).values()}
    for sha256 in connection.execute(sa.select(CONTENTS.c.sha256)).scalars().all():
        if sha256 not in named:
            connection.execute(sa.delete(CONTENTS).where(CONTENTS.c.sha256 == sha256))
