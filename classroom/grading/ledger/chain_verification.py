"""Verify the hash chains: detect rows that were altered, removed or inserted."""

from classroom.grading.ledger import chains

_MERGE, _FORGET, _BEGIN = "merge", "forget", "begin"


def find_alterations(rows, heads=()):
    """List alterations of a ledger: the first altered row of each chain, and missing rows to which
    merges or ``heads`` (hashes noted before) refer. Rewriting all rows can produce valid chains,
    but no chain whose head was noted elsewhere. Therefore, each release prints the head of the
    gradebook's chain.
    """
    of_chains = {}
    for row in sorted(rows, key=lambda row: (row["chain"], row["number"])):
        of_chains.setdefault(row["chain"], []).append(row)
    merged, erased = _merged_and_erased(rows)
    found = []
    for chain in of_chains.values():
        found += _first_altered(chain, erased)[:1]
    hashes = {(row["chain"], row["number"]): row["hash"] for row in rows}
    for where, body in merged:
        for name, (number, hash) in body["theirs"].items():
            if hashes.get((name, number)) != hash:
                found.append(f"{where} merged row {number} of ledger {name}, which is missing")
    for head in heads:
        if not head or not any(known.startswith(head) for known in hashes.values()):
            found.append(f"the head {head} is missing: rows were removed or rewritten")
    return found


def name_of(row):
    return f"row {row['number']} of ledger {row['chain']} ({row['kind']}, {row['at']})"


def _merged_and_erased(rows):
    """Return the bodies of merge rows, and the erased rows, ignoring altered bodies."""
    merged, erased = [], set()
    for row in rows:
        if row["kind"] not in (_MERGE, _FORGET) or not _body_holds(row):
            continue
        body = chains.loaded(row)
        if row["kind"] == _MERGE:
            merged.append((name_of(row), body))
        else:
            erased.update((chain, number) for chain, number in body["rows"])
    return merged, erased


def _first_altered(chain, erased):
    previous = chains.NO_PREVIOUS
    for expected, row in enumerate(chain):
        if row["number"] != expected:
            return [f"row {expected} of ledger {row['chain']} is missing"]
        if row["previous"] != previous or chains.row_hash(row) != row["hash"]:
            return [f"{name_of(row)} or the row before it was altered"]
        if row["body"] is None and (row["chain"], row["number"]) not in erased:
            return [f"{name_of(row)}: its content was deleted without a record of erasure"]
        if row["body"] is not None and not _body_holds(row):
            return [f"{name_of(row)}: its content was altered"]
        previous = row["hash"]
    return []


def _body_holds(row):
    return row["body"] is not None and chains.digest(row["salt"], row["body"]) == row["digest"]
