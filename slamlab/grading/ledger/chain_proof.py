"""Proof of chains: that no row was altered, left out or put in since it was written."""

from slamlab.grading.ledger import chains

_MERGE, _FORGET, _BEGIN = "merge", "forget", "begin"


def altered(rows, heads=()):
    """What is wrong with a ledger: of each chain the first row, then what merges and heads miss.

    Whoever can write all rows anew can make chains that hold. He cannot make them end in a head
    that was written down elsewhere, which is why each release tells one.

    Parameters
    ----------
    rows : list of dict, all of the ledger
    heads : iterable of str, hashes that were told before

    Returns
    -------
    list of str, empty where all is as it was
    """
    of_chains = {}
    for row in sorted(rows, key=lambda row: (row["chain"], row["number"])):
        of_chains.setdefault(row["chain"], []).append(row)
    told, forgotten = _told(rows)
    found = []
    for chain in of_chains.values():
        found += _first_altered(chain, forgotten)[:1]
    hashes = {(row["chain"], row["number"]): row["hash"] for row in rows}
    for where, body in told:
        for name, (number, hash) in body["theirs"].items():
            if hashes.get((name, number)) != hash:
                found.append(f"{where} brought in row {number} of ledger {name}, which is gone")
    for head in heads:
        if not head or not any(known.startswith(head) for known in hashes.values()):
            found.append(f"the head {head} is not there: rows were cut off, or written anew")
    return found


def name_of(row):
    """A row in words."""
    return f"row {row['number']} of ledger {row['chain']} ({row['kind']}, {row['at']})"


def _told(rows):
    """What merges brought in, and what was forgotten; bodies that do not hold tell nothing."""
    merged, forgotten = [], set()
    for row in rows:
        if row["kind"] not in (_MERGE, _FORGET) or not _body_holds(row):
            continue
        body = chains.loaded(row)
        if row["kind"] == _MERGE:
            merged.append((name_of(row), body))
        else:
            forgotten.update((chain, number) for chain, number in body["rows"])
    return merged, forgotten


def _first_altered(chain, forgotten):
    previous = chains.NOTHING
    for expected, row in enumerate(chain):
        if row["number"] != expected:
            return [f"row {expected} of ledger {row['chain']} is gone"]
        if row["previous"] != previous or chains.row_hash(row) != row["hash"]:
            return [f"{name_of(row)} was altered, or the one before it"]
        if row["body"] is None and (row["chain"], row["number"]) not in forgotten:
            return [f"{name_of(row)} was emptied, and nobody was forgotten there"]
        if row["body"] is not None and not _body_holds(row):
            return [f"{name_of(row)} was altered: it says something else than it did"]
        previous = row["hash"]
    return []


def _body_holds(row):
    return row["body"] is not None and chains.digest(row["salt"], row["body"]) == row["digest"]
