"""A ledger in a database: its rows, notes of any kind, what is kept of attempts."""

import sqlalchemy as sa

from slamlab.grading import gradebook_rows
from slamlab.grading.database import Database
from slamlab.grading.ledger import chains, contents, sightings
from slamlab.grading.ledger.chains import LEDGER, Entry


class LedgerBook:
    """A ledger that is opened.

    Parameters
    ----------
    url : str, such as sqlite:////home/me/grades.db or postgresql+psycopg://me@host/course
    who : str or None, who acts, as it stands with each row; None: the account

    Raises
    ------
    GradebookError : from here and every method, when the database cannot be used
    """

    def __init__(self, url, who=None):
        self._database = Database(url, gradebook_rows.TABLES)
        self.who = gradebook_rows.storable(who or self._database.account)[:200]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Close the connections to the database; may be called twice."""
        self._database.close()

    def rows(self, after=0, kinds=None):
        """Rows of the ledger, in order.

        Parameters
        ----------
        after : int, the id of a row; those that were stored after it
        kinds : list of str or None, for all

        Returns
        -------
        list of dict
        """
        asked = [LEDGER.c.id > after] + ([LEDGER.c.kind.in_(kinds)] if kinds else [])
        return self._read(lambda connection: chains.rows(connection, *asked))

    def newest_row(self):
        """The id of the row that was stored last; 0 for none."""
        last = sa.select(sa.func.coalesce(sa.func.max(LEDGER.c.id), 0))
        return self._read(lambda connection: connection.execute(last).scalar_one())

    def contents(self, names):
        """What is kept of attempts, by the hashes that their records name; see :mod:`contents`.

        Parameters
        ----------
        names : iterable of str

        Returns
        -------
        dict, hash to bytes
        """
        return self._read(lambda connection: contents.load(connection, names))

    def note(self, kind, body, submission=None):
        """Append a row of another kind.

        Parameters
        ----------
        kind : str, such as "release"
        body : dict of plain values
        submission : str or None, which it is about

        Returns
        -------
        dict, the row that is the head of the gradebook's own chain now
        """
        if submission is not None:
            body = body | {"submission": submission}
        body = gradebook_rows.storable(body)
        entry = Entry(kind, body, body.get("submission"))

        def noted(connection):
            chains.append(connection, [entry], self.who)
            return chains.own_head(connection)

        return self._write(noted)

    def notes(self, kind):
        """What the rows of a kind say, the oldest first.

        Returns
        -------
        list of dict
        """
        return self._read(lambda connection: chains.bodies(connection, kind))

    def sight(self, found):
        """Number what was handed in, by the order in which it is seen; see :mod:`sightings`.

        Parameters
        ----------
        found : list of (name, hash of its content)

        Returns
        -------
        dict, name to number
        """
        return self._write(lambda connection: sightings.sight(connection, found))

    def _read(self, work):
        return self._database.transact(work)

    def _write(self, work):
        return self._database.transact(work, writes=True)
