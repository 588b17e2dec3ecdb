"""Merge two ledgers: copy the other ledger's chains, and record both heads in a new row."""

from collections import Counter

from classroom.grading.database import GradebookError, sa
from classroom.grading.ledger import chains, student_erasure
from classroom.grading.ledger.chains import LEDGER


def heads(rows):
    """Return the [number, hash] of each chain's last row."""
    found = {}
    for row in sorted(rows, key=lambda row: row["number"]):
        found[row["chain"]] = [row["number"], row["hash"]]
    return dict(sorted(found.items()))


def _forked(row, theirs):
    chain, number = row["chain"], row["number"]
    since = [one for one in theirs if one["chain"] == chain and one["number"] >= number]
    kinds = Counter(one["kind"] for one in since)
    listed = ", ".join(f"{kind}: {count}" for kind, count in sorted(kinds.items()))
    who = ", ".join(sorted({one["who"] for one in since}))
    return (
        f"the gradebooks differ in row {number} of the ledger {chain}. Either one is a copy and "
        "both were used afterwards, or one was altered (check both with slamlab grade verify). "
        f"Since then, {who} added rows to the other gradebook ({listed}). Keep this gradebook. "
        "Grade the other one's submissions here: the same secret gives the same scores. Repeat its "
        "overrides and remarks. If another grader needs a copy, create it with slamlab grade merge "
        "DIR --out COPY"
    )


def merge(connection, theirs, who):
    """Add all rows of another ledger. Raises GradebookError if a chain differs."""
    ours = {(row["chain"], row["number"]): row for row in chains.rows(connection)}
    if not ours:
        chains.append(connection, [], who)  # so that the first chain is this ledger's own
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
    student_erasure.forget_rows(connection, student_erasure.forgotten(connection))
    before = chains.own_head(connection)
    body = {"ours": [before["chain"], before["number"], before["hash"]], "theirs": heads(theirs)}
    chains.append(connection, [chains.Entry("merge", body)], who)
