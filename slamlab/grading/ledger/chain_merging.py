"""Merging ledgers: the other's chains come in as they are, and a row records both heads."""

import sqlalchemy as sa

from slamlab.grading.database import GradebookError
from slamlab.grading.ledger import chains, forgotten_students
from slamlab.grading.ledger.chains import LEDGER


def heads(rows):
    """The last row of each chain.

    Parameters
    ----------
    rows : list of dict

    Returns
    -------
    dict, chain to [number, hash]
    """
    found = {}
    for row in sorted(rows, key=lambda row: row["number"]):
        found[row["chain"]] = [row["number"], row["hash"]]
    return dict(sorted(found.items()))


def merge(connection, theirs, who):
    """Bring another ledger's rows in, within a transaction that writes.

    Parameters
    ----------
    connection : sqlalchemy.Connection
    theirs : list of dict, all rows of the other
    who : str

    Raises
    ------
    GradebookError : a chain went on differently here and there
    """
    ours = {(row["chain"], row["number"]): row for row in chains.rows(connection)}
    if not ours:
        chains.append(connection, [], who)  # so that the first chain here is its own
    new = []
    for row in sorted(theirs, key=lambda row: (row["chain"], row["number"])):
        here = ours.get((row["chain"], row["number"]))
        if here is None:
            new.append({name: value for name, value in row.items() if name != "id"})
        elif here["hash"] != row["hash"]:
            raise GradebookError(
                f"row {row['number']} of the ledger {row['chain']} is another one in the other "
                "gradebook: one of them is a copy in which grading went on, or was altered"
            )
    if not new:
        return
    connection.execute(sa.insert(LEDGER), new)
    forgotten_students.forget_rows(connection, forgotten_students.forgotten(connection))
    before = chains.own_head(connection)
    body = {"ours": [before["chain"], before["number"], before["hash"]], "theirs": heads(theirs)}
    chains.append(connection, [chains.Entry("merge", body)], who)
