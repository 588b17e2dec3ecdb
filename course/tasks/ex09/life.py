"""Right ways and slips of 09-life."""

from course.tasks import Slip, Stumble

TASK = "09-life"

WAYS = {
    "a copy kept up, used as a set": """
def keep_book(book, seen, N, lives):
    book, seen = dict(book), set(seen)
    for i in list(book):
        if i not in seen:
            count, left = book[i]
            book[i] = [count, left - 1]
            if left <= 1:
                del book[i]
    for i in seen:
        book[i] = [book.get(i, [0, 0])[0] + 1, lives]
    return book, {i for i in seen if book[i][0] >= N}
""",
    "one comprehension": """
def keep_book(book, seen, N, lives):
    after = {i: (book.get(i, (0, 0))[0] + 1, lives) for i in seen}
    missed = {i: (n, left - 1) for i, (n, left) in book.items() if i not in after and left > 1}
    return missed | after, tuple(i for i in after if after[i][0] >= N)
""",
    "all ids in one loop": """
def keep_book(book, seen, N, lives):
    after, used = {}, []
    for i in sorted(set(book) | set(seen)):
        count, left = book[i] if i in book else (0, lives)
        if i in seen:
            after[i] = (count + 1, lives)
            if count + 1 >= N:
                used += [i]
        elif left - 1 > 0:
            after[i] = (count, left - 1)
    return after, used
""",
    "by arrays": """
def keep_book(book, seen, N, lives):
    ids = np.union1d(np.array(list(book), dtype=int), np.array(seen, dtype=int))
    here = np.isin(ids, seen)
    count = np.array([book.get(i, (0, 0))[0] for i in ids]) + here
    left = np.where(here, lives, np.array([book.get(i, (0, 0))[1] for i in ids]) - 1)
    after = {int(i): (int(n), int(k)) for i, n, k in zip(ids, count, left) if k > 0}
    return after, np.array([i for i in ids[here] if after[i][0] >= N], dtype=int)
""",
}

STAYS = "if i not in seen and left > 1:"
MISSED = "after[i] = (count, left - 1)"
IDS = "for i in set(seen):"
COUNT = "count = book[i][0] if i in book else 0"
SEEN = "after[i] = (count + 1, lives)"
USED = "used = [i for i in sorted(set(seen)) if after[i][0] >= N]"

SLIPS = (
    Slip(
        "twice",
        "Two sightings of one wall in one scan count twice. The second is dropped: it is the same look "
        "at the same wall.",
        (SEEN, "after[i] = (count + seen.count(i), lives)"),
        [("after = {}", "after = dict(book)"), (IDS, "for i in seen:"),
         (COUNT, "count = after[i][0] if i in after else 0"),
         (STAYS, "if i not in seen and left < 2:\n            del after[i]\n        elif i not in seen:")],
    ),
    Slip(
        "not-restored",
        "A wall that is seen again does not get its lives back. Restore all of them.",
        (SEEN, "after[i] = (count + 1, book[i][1] if i in book else lives)"),
    ),
    Slip(
        "restored-by-one",
        "A wall that is seen again gets one life more. Restore all of them.",
        (SEEN, "after[i] = (count + 1, min(book[i][1] + 1, lives) if i in book else lives)"),
        (SEEN, "after[i] = (count + 1, book[i][1] + 1 if i in book else lives)"),
    ),
    Slip(
        "seen-pays",
        "Walls that were seen pay a life, too. Only those that were not seen do.",
        (SEEN, "after[i] = (count + 1, lives - 1)"),
        (SEEN, "after[i] = (count + 1, lives - (i in book))"),
        """
def keep_book(book, seen, N, lives):
    new = {i: (book.get(i, (0, 0))[0] + 1, lives) for i in set(seen)}
    for i in book:
        count, left = new.get(i, book[i])
        new[i] = (count, left - 1)
    new = {i: entry for i, entry in new.items() if entry[1] > 0}
    return new, [i for i in sorted(set(seen)) if i in new and new[i][0] >= N]
""",
    ),
    Slip(
        "paid-to-each-wall-seen",
        "A wall that is not seen pays a life to each wall that is: one loop stands inside the other. A scan "
        "costs it one life, whether it shows ten walls or none.",
        *(
            f"""
def keep_book(book, seen, N, lives):
    book = dict(book)
    for i in {each}:
        book[i] = (book.get(i, (0, 0))[0] + 1, lives)
        for k in list(book):
            if k not in seen:
                book[k] = (book[k][0], book[k][1] - 1)
                if book[k][1] == 0:
                    del book[k]
    return book, [i for i in sorted(set(seen)) if book[i][0] >= N]
"""
            for each in ("set(seen)", "seen")
        ),
    ),
    Slip(
        "one-life-too-many",
        "A sighting gives one life more than there are.",
        (SEEN, "after[i] = (count + 1, lives + 1)"),
    ),
    Slip(
        "late",
        "A wall with no life left is still in the book. At 0 it goes.",
        (STAYS, "if i not in seen and left > 0:"),
        (STAYS, "if i not in seen and left >= 0:"),
    ),
    Slip(
        "early",
        "A wall goes with a life left: at 0, not at 1.",
        (STAYS, "if i not in seen and left > 2:"),
    ),
    Slip(
        "immortal",
        "Walls never leave the book, or never pay. Who has no life left is deleted, in x and P as well.",
        (STAYS, "if i not in seen:"),
        (MISSED, "after[i] = (count, left)"),
    ),
    Slip(
        "forgotten-at-once",
        "Walls that are not seen leave the book at once. They lose a life each, as long as they have "
        "more than one.",
        (MISSED, "pass"),
    ),
    Slip(
        "reborn",
        "A wall that died and comes back remembers its old sightings. It is a new one.",
        """
memory = {}

def keep_book(book, seen, N, lives):
    after = {}
    if not book:
        memory.clear()
    for i, (count, left) in book.items():
        memory[i] = count
        if i not in seen and left > 1:
            after[i] = (count, left - 1)
    for i in set(seen):
        after[i] = (memory.get(i, 0) + 1, lives)
    return after, [i for i in set(seen) if after[i][0] >= N]
""",
    ),
    Slip(
        "consecutive",
        "A scan without a wall sets its sightings back. It costs a life, no more.",
        (MISSED, "after[i] = (0, left - 1)"),
        (MISSED, "after[i] = (count - 1, left - 1)"),
    ),
    Slip(
        "not-counted",
        "The sightings do not count up, or a new wall comes in without the one that brought it.",
        (SEEN, "after[i] = (count, lives)"),
        (SEEN, "after[i] = (1, lives)"),
        (SEEN, "after[i] = (count + (i in book), lives)"),
    ),
    Slip(
        "counted-too-early",
        "A new wall begins with more than one sighting.",
        (COUNT, "count = book[i][0] if i in book else 1"),
    ),
    Slip(
        "unseen-counted",
        "A scan without the wall counts as a sighting, too.",
        (MISSED, "after[i] = (count + 1, left - 1)"),
    ),
    Slip(
        "swapped",
        "Sightings and lives stand in the wrong order: an entry is (sightings, lives left).",
        [(MISSED, "after[i] = (left - 1, count)"), (SEEN, "after[i] = (lives, count + 1)"),
         ("for i, (count, left)", "for i, (left, count)"),
         (COUNT, "count = book[i][1] if i in book else 0"), ("after[i][0]", "after[i][1]")],
    ),
    Slip(
        "one-too-many",
        "Used from sighting N + 1 on, or from the one before the N-th. The N-th, this scan's included, "
        "is the first.",
        (USED, USED.replace(">=", ">")),
        (USED, USED.replace(">= N", ">= N - 1")),
        (USED, "used = [i for i in sorted(set(seen)) if i in book and book[i][0] >= N]"),
        (USED, USED.replace(">=", "==")),
    ),
    Slip(
        "new-walls-not-used",
        "A wall that is new is never used. With N = 1 its first sighting is enough.",
        (USED, "used = [i for i in sorted(set(seen)) if i in book and after[i][0] >= N]"),
    ),
    Slip("at-once", "Walls are used at their first sighting: N is not asked.",
         (USED, "used = sorted(set(seen))")),
    Slip(
        "lives-for-sightings",
        "N was compared with the lives left. It is the sightings that must be N.",
        (USED, USED.replace("[0]", "[1]")),
    ),
    Slip(
        "unseen-used",
        "Walls that are not in this scan are among those used. There is nothing to update them with.",
        (USED, "used = [i for i in after if after[i][0] >= N]"),
    ),
    Slip(
        "used-twice",
        "A wall that was seen twice in a scan is used twice. Drop the second sighting.",
        (USED, "used = [i for i in seen if after[i][0] >= N]"),
    ),
    Slip(
        "ids-with-gaps",
        "Ids were taken for places in a list, or id 0 for none. They are names, any whole numbers from 0 "
        "on.",
        (USED, "used = [i for i in sorted(set(seen)) if i and after[i][0] >= N]"),
        (USED, "used = [k for k, i in enumerate(sorted(set(seen))) if after[i][0] >= N and k in seen]"),
    ),
)  # fmt: skip

STUMBLES = (
    Stumble("malformed", ("return after, used", "return after")),
    Stumble(
        "malformed", ("return after, used", "return {i: c for i, (c, _) in after.items()}, used")
    ),
    Stumble("raised", (IDS, "for i in seen[0]:")),
    Stumble("not attempted", "def keep_book(book, seen, N, lives):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
