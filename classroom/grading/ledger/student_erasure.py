"""Erase a student's name and contents (right to erasure). Hashes are kept, so chains stay valid."""

from classroom.grading.database import sa
from classroom.grading.ledger import chains, content_store, submission_order
from classroom.grading.ledger.chains import LEDGER


def forget(connection, student, who):
    """Delete all data of a student from the ledger; return the deleted plain records."""
    if connection.dialect.name == "sqlite":  # overwrite deleted data, for any build of SQLite
        connection.exec_driver_sql("PRAGMA secure_delete = ON")
    of_all = [row for row in chains.rows(connection) if row["body"] is not None]
    bodies = [(row, chains.loaded(row)) for row in of_all]
    mine = [body["record"] for row, body in bodies
            if row["kind"] == "attempt" and body["record"]["student"] == student]  # fmt: skip
    names = {record["submission"] for record in mine}
    found = [row for row, body in bodies if body.get("submission") in names]
    if not found:
        return []
    listed = [[row["chain"], row["number"]] for row in found]
    kept = sorted({record["sha256"] for record in mine if record["sha256"]})
    entry = chains.Entry("forget", {"rows": listed, "sha256": kept})
    chains.append(connection, [entry], who)
    forget_rows(connection, listed)
    submission_order.forget(connection, names)
    return mine


def forgotten(connection):
    """Return the erased rows as [chain, number]."""
    return [row for body in chains.bodies(connection, "forget") for row in body["rows"]]


def forget_rows(connection, listed):
    """Delete the bodies of rows, and the contents to which no other row refers."""
    emptied = dict.fromkeys(("body", "salt", "about"))
    for chain, number in listed:
        row = (LEDGER.c.chain == chain) & (LEDGER.c.number == number)
        connection.execute(sa.update(LEDGER).where(row).values(emptied))
    if listed:
        content_store.drop_unnamed(connection)
