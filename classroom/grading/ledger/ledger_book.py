"""Ledger in a database: rows, notes of any kind, and stored contents."""

from classroom.grading import gradebook_rows
from classroom.grading.database import TABLES, Database, sa
from classroom.grading.ledger import chains, content_store, submission_order
from classroom.grading.ledger.chains import LEDGER, Entry


class LedgerBook:
    """A ledger in a database; rows record the user ``who``. Methods can raise GradebookError."""

    def __init__(self, url, who=None):
        self._database = Database(url, TABLES)
        self.who = gradebook_rows.storable(who or self._database.account)[:200]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._database.close()

    def rows(self, after=0, kinds=None):
        """Return the rows whose ids exceed ``after``, in order, as dicts."""
        asked = [LEDGER.c.id > after] + ([LEDGER.c.kind.in_(kinds)] if kinds else [])
        return self._read(lambda connection: chains.rows(connection, *asked))

    def newest_row(self):
        """Return the id of the last row, or 0."""
        last = sa.select(sa.func.coalesce(sa.func.max(LEDGER.c.id), 0))
        return self._read(lambda connection: connection.execute(last).scalar_one())

    def contents(self, names):
        return self._read(lambda connection: content_store.load(connection, names))

    def note(self, kind, body, submission=None):
        """Append a row, such as "release"; return the head of the gradebook's own chain."""
        if submission is not None:
            body = body | {"submission": submission}
        body = gradebook_rows.storable(body)
        entry = Entry(kind, body, body.get("submission"))

        def noted(connection):
            chains.append(connection, [entry], self.who)
            return chains.own_head(connection)

        return self._write(noted)

    def notes(self, kind):
        """Return the bodies of all rows of a kind, oldest first."""
        return self._read(lambda connection: chains.bodies(connection, kind))

    def number_submissions(self, found):
        return self._write(
            lambda connection: submission_order.number_submissions(connection, found)
        )

    def _read(self, work):
        return self._database.transact(work)

    def _write(self, work):
        return self._database.transact(work, writes=True)
