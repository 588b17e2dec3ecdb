"""Migration of older gradebooks without a ledger: their rows become the first rows of a ledger."""

from classroom.grading.database import sa
from classroom.grading.ledger import chains

_OLDER = sa.MetaData()
_ATTEMPTS = sa.Table(
    "attempts", _OLDER, *(sa.Column(name) for name in ("id", "key", "submission", "at")),
    sa.Column("record", sa.JSON),
)  # fmt: skip
_OVERRIDES = sa.Table(
    "adjustments", _OLDER,
    *(sa.Column(n) for n in ("id", "submission", "exercise", "task", "points", "reason", "at")),
)  # fmt: skip


def is_older(connection):
    return {_ATTEMPTS.name, _OVERRIDES.name} <= set(sa.inspect(connection).get_table_names())


def migrate(connection, who):
    """Copy the rows of the older tables into the ledger, and drop these tables."""
    if not is_older(connection):  # another process has migrated it
        return
    entries = []
    for row in connection.execute(sa.select(_ATTEMPTS).order_by(_ATTEMPTS.c.id)).mappings():
        body = {"key": row["key"], "submission": row["submission"], "record": row["record"]}
        entries.append(chains.Entry("attempt", body, row["submission"], row["at"]))
    for row in connection.execute(sa.select(_OVERRIDES).order_by(_OVERRIDES.c.id)).mappings():
        body = {name: row[name] for name in ("submission", "exercise", "task", "points", "reason")}
        entries.append(chains.Entry("override", body, row["submission"], row["at"]))
    chains.append(connection, entries, who)
    for table in (_ATTEMPTS, _OVERRIDES):
        connection.execute(sa.schema.DropTable(table))
