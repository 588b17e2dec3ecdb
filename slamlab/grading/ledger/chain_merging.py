"""Merging ledgers: the other's chains come in as they are, and a row records both heads."""

from collections import Counter

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


def _forked(row, theirs):
    """Why a chain that went on in both is not merged, and what to do.

    Which of two rows came first no hash tells, and put into one chain either would be rewritten.
    """
    chain, number = row["chain"], row["number"]
    since = [one for one in theirs if one["chain"] == chain and one["number"] >= number]
    kinds = Counter(one["kind"] for one in since)
    listed = ", ".join(f"{kind}: {count}" for kind, count in sorted(kinds.items()))
    who = ", ".join(sorted({one["who"] for one in since}))
    return (
        f"row {number} of the ledger {chain} is another one in the other gradebook: one of them is "
        f"a copy, and both went on, or one was altered (slamlab grade verify tells). The other one "
        f"has since then, by {who}: {listed}. Keep this one; grade here what was graded there, by "
        "the same secret it gets the same marks, and repeat what was done by hand. To let somebody "
        "go on from a copy, give a gradebook that was merged: slamlab grade merge DIR --out COPY"
    )


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
            raise GradebookError(_forked(row, theirs))
    if not new:
        return
    connection.execute(sa.insert(LEDGER), new)
    forgotten_students.forget_rows(connection, forgotten_students.forgotten(connection))
    before = chains.own_head(connection)
    body = {"ours": [before["chain"], before["number"], before["hash"]], "theirs": heads(theirs)}
    chains.append(connection, [chains.Entry("merge", body)], who)
