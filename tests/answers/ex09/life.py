"""Independent answers to 09-life: right ones, and students' mistakes."""

RIGHT = [
    (
        "09-life",
        "a copy of the book, changed in three passes",
        """
def keep_book(book, seen, N, lives):
    new = dict(book)
    here = set(seen)
    for i in list(new):
        if i not in here:
            count, left = new[i]
            if left == 1:
                del new[i]
            else:
                new[i] = (count, left - 1)
    used = []
    for i in here:
        count = new.get(i, (0, 0))[0] + 1
        new[i] = (count, lives)
        if count >= N:
            used.append(i)
    return new, used
""",
    ),
    (
        "09-life",
        "comprehensions",
        """
def keep_book(book, seen, N, lives):
    seen = list(dict.fromkeys(seen))
    missed = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left - 1 > 0}
    found = {i: (book.get(i, (0, lives))[0] + 1, lives) for i in seen}
    return missed | found, [i for i, (n, _) in found.items() if n >= N]
""",
    ),
]

WRONG = [
    (
        "09-life",
        "twice in one scan counts twice",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i in seen or left > 1}
    for i in seen:
        n = new[i][0] if i in new else 0
        new[i] = (n + 1, lives)
    return new, sorted({i for i in seen if new[i][0] >= N})
""",
    ),
    (
        "09-life",
        "N exclusive",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] > N]
""",
    ),
    (
        "09-life",
        "used by the book before this scan",
        """
def keep_book(book, seen, N, lives):
    used = [i for i in set(seen) if i in book and book[i][0] >= N]
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, used
""",
    ),
    (
        "09-life",
        "used are all of the book with N sightings",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i, (n, _) in new.items() if n >= N]
""",
    ),
    (
        "09-life",
        "leaves the book at -1: one life too many",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            continue
        if left - 1 >= 0:
            new[i] = (n, left - 1)
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "leaves the book at 1: one life too few",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i not in seen and left > 2:
            new[i] = (n, left - 1)
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "lives are not given back",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n + 1, left)
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        if i not in book:
            new[i] = (1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "gets one life back, not all",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n + 1, min(left + 1, lives))
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        if i not in book:
            new[i] = (1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "changes the book it is given",
        """
def keep_book(book, seen, N, lives):
    for i in list(book):
        if i not in seen:
            n, left = book[i]
            book[i] = (n, left - 1)
            if left <= 1:
                del book[i]
    for i in set(seen):
        book[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return book, [i for i in set(seen) if book[i][0] >= N]
""",
    ),
    (
        "09-life",
        "deletes while it goes through the dict",
        """
def keep_book(book, seen, N, lives):
    book = dict(book)
    for i in book:
        if i not in seen:
            n, left = book[i]
            if left == 1:
                del book[i]
            else:
                book[i] = (n, left - 1)
    for i in set(seen):
        book[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return book, [i for i in set(seen) if book[i][0] >= N]
""",
    ),
    (
        "09-life",
        "all lose a life first: a wall with one life is dropped though it is seen",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if left > 1}
    for i in set(seen):
        new[i] = (new[i][0] + 1 if i in new else 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "a new wall comes in with no sighting",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n + 1, lives)
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        new.setdefault(i, (0, lives))
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "a new wall is never used, even with N = 1",
        """
def keep_book(book, seen, N, lives):
    new, used = {}, []
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n + 1, lives)
            if n + 1 >= N:
                used.append(i)
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        if i not in book:
            new[i] = (1, lives)
    return new, used
""",
    ),
    (
        "09-life",
        "an empty scan costs no lives",
        """
def keep_book(book, seen, N, lives):
    if len(seen) == 0:
        return dict(book), []
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "used lists a wall as often as it stands in the scan",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in seen if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "sightings reset when a scan is missed",
        """
def keep_book(book, seen, N, lives):
    new = {i: (0, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "what has been used once never leaves the book",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i not in seen and (left > 1 or n >= N):
            new[i] = (n, max(left - 1, 1))
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
]
