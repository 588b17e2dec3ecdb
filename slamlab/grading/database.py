"""Database of a gradebook: opened for its owner alone, its tables made once, waited for when lost.

A transaction that fails because the server went away is tried again until it is back or patience
ends, so that a class that is being graded survives a restart of its database.
"""

import contextlib
import getpass
import os
import sys

import sqlalchemy as sa

from slamlab.devices.clock import Clock

WAIT_SECONDS = 60.0  # for a database that is lost [s]
RETRY_SECONDS = 1.0  # between two tries [s]
# so that a server whose machine is gone is missed, too; names of libpq's options
LIBPQ_OPTIONS = {
    "connect_timeout": 10,
    "keepalives_idle": 10,
    "keepalives_interval": 5,
    "keepalives_count": 3,
    "tcp_user_timeout": 30_000,
}
LIBPQ_DRIVERS = ("psycopg", "psycopg2")
MOST_RACES = 20  # lost against other processes, where a database has no lock below
# of two processes that come at once the second waits until the first is done
LOCKS = {"postgresql": "SELECT pg_advisory_xact_lock(1936482669)", "sqlite": "BEGIN IMMEDIATE"}
PASSING = (sa.exc.OperationalError, sa.exc.InterfaceError, sa.exc.TimeoutError)
"""Errors that may pass: the server is gone or locked, the disk is full."""
PASSING_SQLITE = ("BUSY", "LOCKED", "FULL", "IOERR", "CANTOPEN")
"""Of SQLite's own those: a file that may not be written to stays so."""


class GradebookError(Exception):
    """The gradebook's database cannot be used; the text says why."""


class Database:
    """Transactions of a database that SQLAlchemy speaks to.

    Parameters
    ----------
    url : str
    tables : sqlalchemy.MetaData, made where they are missing
    clock : Clock or SimulatedClock, by which a lost database is waited for
    tell : callable(str), is told that it is waited for

    Raises
    ------
    GradebookError
    """

    def __init__(self, url, tables, clock=None, tell=None):
        self._clock, self._tell = clock or Clock(), tell or _tell
        try:
            self._engine = sa.create_engine(url, connect_args=_options(sa.make_url(url)))
            _make_private(self._engine.url)
            self._make_tables(tables)
        except (sa.exc.SQLAlchemyError, ModuleNotFoundError) as error:
            raise GradebookError(f"the gradebook cannot be opened: {_said(error)}") from None

    @property
    def account(self):
        """The account by which the database is used: its own, else this machine's."""
        return self._engine.url.username or _account_here()

    def close(self):
        """Close the connections; may be called twice."""
        self._engine.dispose()

    def transact(self, work, writes=False):
        """Run a function of a connection in a transaction: all that it writes is there, or nothing.

        It may run twice, when the answer to a commit is lost: it must not double anything.

        Parameters
        ----------
        work : connection -> anything
        writes : bool, whether it waits until no other one writes

        Returns
        -------
        what the function gives

        Raises
        ------
        GradebookError : the database is lost, or refuses
        """
        end, races = None, 0
        while True:
            try:
                with self._engine.begin() as connection:
                    if writes:
                        self._lock(connection)
                    return work(connection)
            except sa.exc.IntegrityError as error:  # another process wrote the same row just now
                if races == MOST_RACES:
                    raise GradebookError(f"the gradebook refuses: {_said(error)}") from None
                races += 1
            except PASSING as error:
                if not _may_pass(error):
                    raise GradebookError(f"the gradebook refuses: {_said(error)}") from None
                self._engine.dispose()
                end = self._wait(end, _said(error))
            except sa.exc.SQLAlchemyError as error:
                raise GradebookError(f"the gradebook refuses: {_said(error)}") from None

    def _wait(self, end, said):
        """Wait a moment for a lost database; until when in all."""
        if end is None:
            end = self._clock.now() + WAIT_SECONDS
            self._tell(f"the gradebook does not answer, waiting up to {WAIT_SECONDS:g} s: {said}")
        if self._clock.now() >= end:
            raise GradebookError(
                f"the gradebook did not come back within {WAIT_SECONDS:g} s: {said}. What it holds "
                "is safe; the same command goes on from there"
            )
        self._clock.sleep(RETRY_SECONDS)
        return end

    def _make_tables(self, tables):
        """Make what is missing; a file that another program has locked is waited for."""
        end = None
        while True:
            try:
                if set(tables.tables) <= set(sa.inspect(self._engine).get_table_names()):
                    return
                with self._engine.begin() as connection:
                    self._lock(connection)
                    tables.create_all(connection)
            except sa.exc.OperationalError as error:
                if _sqlite_error(error) != "BUSY":  # a wrong address stays wrong: told at once
                    raise
                self._engine.dispose()
                end = self._wait(end, _said(error))

    def _lock(self, connection):
        lock = LOCKS.get(self._engine.dialect.name)
        if lock:
            connection.exec_driver_sql(lock)


def _options(url):
    if url.get_backend_name() != "postgresql" or url.get_driver_name() not in LIBPQ_DRIVERS:
        return {}
    return {name: value for name, value in LIBPQ_OPTIONS.items() if name not in url.query}


def _make_private(url):
    """Make a file of SQLite that only its owner reads; what others could read is closed to them."""
    if url.get_backend_name() != "sqlite" or not url.database or url.database == ":memory:":
        return
    with contextlib.suppress(OSError):  # SQLite says it better
        os.close(os.open(url.database, os.O_RDWR | os.O_CREAT, 0o600))
        if os.stat(url.database).st_mode & 0o007:
            os.chmod(url.database, 0o600)


def _account_here():
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # a user without a name
        return f"user {os.getuid()}" if hasattr(os, "getuid") else "unknown"


def _sqlite_error(error):
    """SQLite's own name of an error, such as "BUSY"; "" for those of other databases."""
    return (getattr(error.orig, "sqlite_errorname", None) or "_").split("_")[1]


def _may_pass(error):
    name = _sqlite_error(error) if isinstance(error, sa.exc.DBAPIError) else ""
    return not name or name in PASSING_SQLITE


def _said(error):
    if isinstance(error, sa.exc.DBAPIError) and _sqlite_error(error) == "BUSY":
        return "another program has locked it"
    text = str(getattr(error, "orig", None) or error)
    return (text.strip().splitlines() or [type(error).__name__])[0][:300]


def _tell(text):
    print(f"slamlab grade: {text}", file=sys.stderr, flush=True)
