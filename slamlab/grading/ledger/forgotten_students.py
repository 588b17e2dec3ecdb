"""Forgetting: a student's name and content are deleted, the hashes stay, so that chains hold."""

import sqlalchemy as sa

from slamlab.grading.ledger import chains, contents, sightings
from slamlab.grading.ledger.chains import LEDGER


def forget(connection, student, who):
    """Delete all that the ledger says of a student, within a transaction that writes.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    student : str, the id in the roster, or the name as the tables have it
    who : str

    Returns
    -------
    list of Record's plain form, what was deleted of attempts
    """
    if connection.dialect.name == "sqlite":  # deleted is overwritten, however it was built
        connection.exec_driver_sql("PRAGMA secure_delete = ON")
    of_all = [row for row in chains.rows(connection) if row["body"] is not None]
    told = [(row, chains.loaded(row)) for row in of_all]
    mine = [body["record"] for row, body in told
            if row["kind"] == "attempt" and body["record"]["student"] == student]  # fmt: skip
    names = {record["submission"] for record in mine}
    found = [row for row, body in told if body.get("submission") in names]
    if not found:
        return []
    listed = [[row["chain"], row["number"]] for row in found]
    kept = sorted({record["sha256"] for record in mine if record["sha256"]})
    entry = chains.Entry("forget", {"rows": listed, "sha256": kept})
    chains.append(connection, [entry], who)
    forget_rows(connection, listed)
    sightings.forget(connection, names)
    return mine


def forgotten(connection):
    """The rows that were forgotten, as the ledger tells.

    Returns
    -------
    list of [chain, number]
    """
    return [place for body in chains.bodies(connection, "forget") for place in body["rows"]]


def forget_rows(connection, listed):
    """Delete the bodies of rows, and what is kept of contents that no other row names.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    listed : list of [chain, number]
    """
    emptied = dict.fromkeys(("body", "salt", "about"))
    for chain, number in listed:
        row = (LEDGER.c.chain == chain) & (LEDGER.c.number == number)
        connection.execute(sa.update(LEDGER).where(row).values(emptied))
    if listed:
        contents.drop_unnamed(connection)
