"""Gradebook database, which only its owner can open; the database schema is in ``ledger``.
If the connection to the server is lost, a
transaction is retried until the server responds or a time limit expires.
"""

import contextlib
import getpass
import os
import sys

from slamlab.devices.clock import Clock
from slamlab.extras import needs

# all of grading imports SQLAlchemy from here: if it is missing, one message names the extra
with needs("grading", "slam-course"):
    import sqlalchemy as sa
    from sqlalchemy.dialects import mysql

TABLES = sa.MetaData()
"""All tables of a gradebook; :mod:`classroom.grading.ledger` defines those of the ledger."""
LONG_TEXT = sa.Text().with_variant(mysql.MEDIUMTEXT(), "mysql", "mariadb")

WAIT_SECONDS = 60.0  # for a lost database [s]
RETRY_SECONDS = 1.0  # between two attempts [s]
# options of libpq, so that a machine that has disappeared is detected, too
LIBPQ_OPTIONS = {
    "connect_timeout": 10,
    "keepalives_idle": 10,
    "keepalives_interval": 5,
    "keepalives_count": 3,
    "tcp_user_timeout": 30_000,
}
LIBPQ_DRIVERS = ("psycopg", "psycopg2")
MAX_RETRIES = 20  # after conflicts with other processes, for databases without a lock below
# a second process waits until the first has finished
LOCKS = {"postgresql": "SELECT pg_advisory_xact_lock(1936482669)", "sqlite": "BEGIN IMMEDIATE"}
TRANSIENT_ERRORS = (sa.exc.OperationalError, sa.exc.InterfaceError, sa.exc.TimeoutError)
"""Errors that a retry may resolve: the server is unreachable or locked, or the disk is full."""
TRANSIENT_SQLITE_ERRORS = ("BUSY", "LOCKED", "FULL", "IOERR", "CANTOPEN")
"""SQLite's transient errors; missing write permission is not transient."""


class GradebookError(Exception):
    """The gradebook's database cannot be used; the message states why."""


class Database:
    """Database transactions through SQLAlchemy. ``notify`` receives a message if the connection is
    lost. Every method can raise GradebookError.
    """

    def __init__(self, url, tables, clock=None, notify=None):
        self._clock, self._notify = clock or Clock(), notify or _notify
        try:
            self._engine = sa.create_engine(url, connect_args=_options(sa.make_url(url)))
            _make_private(self._engine.url)
            self._make_tables(tables)
        except (sa.exc.SQLAlchemyError, ModuleNotFoundError) as error:
            raise GradebookError(f"the gradebook cannot be opened: {_first_line(error)}") from None

    @property
    def account(self):
        return self._engine.url.username or _account_here()

    def close(self):
        """Close the connections; a second call has no effect."""
        self._engine.dispose()

    def transact(self, work, writes=False):
        """Return ``work(connection)``, which runs in one transaction, exclusive if ``writes``. If
        the response to a commit is lost, the work may run twice, so it must be idempotent.
        """
        end, races = None, 0
        while True:
            try:
                with self._engine.begin() as connection:
                    if writes:
                        self._lock(connection)
                    return work(connection)
            except sa.exc.IntegrityError as error:  # another process has just written the same row
                if races == MAX_RETRIES:
                    raise _refusal(error) from None
                races += 1
            except TRANSIENT_ERRORS as error:
                if not _is_transient(error):
                    raise _refusal(error) from None
                self._engine.dispose()
                end = self._wait(end, _first_line(error))
            except sa.exc.SQLAlchemyError as error:
                raise _refusal(error) from None

    def _wait(self, end, why):
        """Wait RETRY_SECONDS for a lost database; return the time at which to give up."""
        if end is None:
            end = self._clock.now() + WAIT_SECONDS
            self._notify(f"the gradebook does not answer; waiting up to {WAIT_SECONDS:g} s: {why}")
        if self._clock.now() >= end:
            raise GradebookError(
                f"the gradebook did not answer within {WAIT_SECONDS:g} s: {why}. Its contents are "
                "safe. Run the same command again to continue"
            )
        self._clock.sleep(RETRY_SECONDS)
        return end

    def _make_tables(self, tables):
        """Create missing tables; wait while another program has locked the file."""
        end = None
        while True:
            try:
                if set(tables.tables) <= set(sa.inspect(self._engine).get_table_names()):
                    return
                with self._engine.begin() as connection:
                    self._lock(connection)
                    tables.create_all(connection)
            except sa.exc.OperationalError as error:
                if _sqlite_error(error) != "BUSY":  # such as a wrong address: waiting does not help
                    raise
                self._engine.dispose()
                end = self._wait(end, _first_line(error))

    def _lock(self, connection):
        lock = LOCKS.get(self._engine.dialect.name)
        if lock:
            connection.exec_driver_sql(lock)


def _options(url):
    if url.get_backend_name() != "postgresql" or url.get_driver_name() not in LIBPQ_DRIVERS:
        return {}
    return {name: value for name, value in LIBPQ_OPTIONS.items() if name not in url.query}


def _make_private(url):
    """Create an SQLite file that only its owner can read, or revoke other users' access to it."""
    if url.get_backend_name() != "sqlite" or not url.database or url.database == ":memory:":
        return
    with contextlib.suppress(OSError):  # SQLite then reports the error
        os.close(os.open(url.database, os.O_RDWR | os.O_CREAT, 0o600))
        if os.stat(url.database).st_mode & 0o007:
            os.chmod(url.database, 0o600)


def _account_here():
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # a user without a name
        return f"user {os.getuid()}" if hasattr(os, "getuid") else "unknown"


def _sqlite_error(error):
    """Return SQLite's name for an error, such as "BUSY", or "" for other databases."""
    return (getattr(error.orig, "sqlite_errorname", None) or "_").split("_")[1]


def _is_transient(error):
    name = _sqlite_error(error) if isinstance(error, sa.exc.DBAPIError) else ""
    return not name or name in TRANSIENT_SQLITE_ERRORS


def _refusal(error):
    return GradebookError(f"the gradebook reports an error: {_first_line(error)}")


def _first_line(error):
    if isinstance(error, sa.exc.DBAPIError) and _sqlite_error(error) == "BUSY":
        return "another program has locked the file"
    text = str(getattr(error, "orig", None) or error)
    return (text.strip().splitlines() or [type(error).__name__])[0][:300]


def _notify(text):
    print(f"slamlab grade: {text}", file=sys.stderr, flush=True)
