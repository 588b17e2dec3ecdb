# %% way: a copy kept up, used as a set
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

# %% way: one comprehension
def keep_book(book, seen, N, lives):
    after = {i: (book.get(i, (0, 0))[0] + 1, lives) for i in seen}
    missed = {i: (n, left - 1) for i, (n, left) in book.items() if i not in after and left > 1}
    return missed | after, tuple(i for i in after if after[i][0] >= N)

# %% way: all ids in one loop
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

# %% way: by arrays
def keep_book(book, seen, N, lives):
    ids = np.union1d(np.array(list(book), dtype=int), np.array(seen, dtype=int))
    here = np.isin(ids, seen)
    count = np.array([book.get(i, (0, 0))[0] for i in ids]) + here
    left = np.where(here, lives, np.array([book.get(i, (0, 0))[1] for i in ids]) - 1)
    after = {int(i): (int(n), int(k)) for i, n, k in zip(ids, count, left) if k > 0}
    return after, np.array([i for i in ids[here] if after[i][0] >= N], dtype=int)

# %% right: sets and a new dict by comprehension
def keep_book(book, seen, N, lives):
    here = set(seen)
    new = {i: (n + 1, lives) if i in here else (n, left - 1) for i, (n, left) in book.items()}
    new = {i: v for i, v in new.items() if v[1] > 0} | {i: (1, lives) for i in here - set(book)}
    return new, [i for i in here if new[i][0] >= N]

# %% right: comprehensions
def keep_book(book, seen, N, lives):
    seen = list(dict.fromkeys(seen))
    missed = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left - 1 > 0}
    found = {i: (book.get(i, (0, lives))[0] + 1, lives) for i in seen}
    return missed | found, [i for i, (n, _) in found.items() if n >= N]

# %% right: in a copy of the book, by counters
from collections import Counter

def keep_book(book, seen, N, lives):
    page, once = {id: list(entry) for id, entry in book.items()}, Counter(seen)
    for id in once:
        page.setdefault(id, [0, 0])
        page[id][0] += 1
        page[id][1] = lives + 1
    for id in list(page):
        page[id][1] -= 1
        if page[id][1] < 1:
            page.pop(id)
    return {id: tuple(e) for id, e in page.items()}, [id for id in once if page[id][0] >= N]

# %% right: a new book from the union of old and seen
def keep_book(book, seen, N, lives):
    now, new = set(seen), {}
    for id in now | set(book):
        times, left = book.get(id, (0, lives))
        times, left = (times + 1, lives) if id in now else (times, left - 1)
        if left > 0:
            new[id] = (times, left)
    return new, [id for id in now if new[id][0] >= N]

# %% wrong: changes the book it is given
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

# %% wrong: deletes while it goes through the dict
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

# %% wrong: all lose a life first: a wall with one life is dropped though it is seen
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if left > 1}
    for i in set(seen):
        new[i] = (new[i][0] + 1 if i in new else 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]

# %% wrong: an empty scan costs no lives
def keep_book(book, seen, N, lives):
    if len(seen) == 0:
        return dict(book), []
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
