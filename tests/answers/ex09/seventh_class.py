"""A seventh class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "09-update",
        "information form",
        """
def update(x, P, z, j, R):
    k = 3 + 2 * j
    rho, alpha = x[k : k + 2]
    n = np.array([np.cos(alpha), np.sin(alpha)])
    H = np.zeros((2, len(x)))
    H[0, :2], H[0, k], H[0, k + 1] = -n, 1, x[0] * n[1] - x[1] * n[0]
    H[1, 2], H[1, k + 1] = -1, 1
    e = z - np.array([rho - n @ x[:2], alpha - x[2]])
    e[1] = np.angle(np.exp(1j * e[1]))
    K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
    I_KH = np.eye(len(x)) - K @ H
    return x + K @ e, I_KH @ P @ I_KH.T + K @ R @ K.T
""",
    ),
    (
        "09-life",
        "in a copy of the book, by counters",
        """
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
""",
    ),
]

WRONG = [
    (
        "09-place",
        "through two points of the wall, and the bearing errs in the angle alone",
        """
def place(x, P, z, R):
    c, s = np.cos(x[2]), np.sin(x[2])
    Rot = np.array([[c, -s], [s, c]])
    n = np.array([np.cos(z[1]), np.sin(z[1])])
    foot = z[0] * n
    A, B = x[:2] + Rot @ foot, x[:2] + Rot @ (foot + [-n[1], n[0]])
    along = B - A
    alpha = np.arctan2(-along[0], along[1])
    rho = A @ [np.cos(alpha), np.sin(alpha)]
    ca, sa = np.cos(alpha), np.sin(alpha)
    Jr = np.array([[ca, sa, -A[0] * sa + A[1] * ca], [0, 0, 1]])
    Jz = np.array([[1, 0], [0, 1]])
    return np.array([rho, alpha]), Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-place",
        "by forward differences with a large step",
        """
def place(x, P, z, R):
    def line(x, z):
        a = x[2] + z[1]
        return np.array([z[0] + x[0] * np.cos(a) + x[1] * np.sin(a), a])
    e = 0.01
    Jr = np.column_stack([(line(x + e * d, z) - line(x, z)) / e for d in np.eye(3)])
    Jz = np.column_stack([(line(x, z + e * d) - line(x, z)) / e for d in np.eye(2)])
    return line(x, z), Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-update",
        "the seen line is placed in the world first, and the innovation taken there",
        """
def update(x, P, z, j, R):
    k = 3 + 2 * j
    line, C, X = place(x[:3], P[:3, :3], z, R)
    H = np.zeros((2, len(x)))
    H[0, k] = H[1, k + 1] = 1
    v = line - x[k : k + 2]
    v[1] = wrap(v[1])
    S = H @ P @ H.T + C
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-life",
        "walls out of the scan lose a life, and the used ones come from the old book",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for id in book:
        count, left = book[id]
        if id in seen:
            new[id] = (count + 1, lives)
        elif left > 1:
            new[id] = (count, left - 1)
    for id in seen:
        if id not in new:
            new[id] = (1, lives)
    used = [id for id in book if id in seen and book[id][0] + 1 >= N]
    return new, used
""",
    ),
    (
        "09-life",
        "all lose a life, the seen ones get one more",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for id, (count, left) in book.items():
        if left - 1 > 0 or id in seen:
            new[id] = (count, left - 1)
    for id in set(seen):
        count, left = new.get(id, (0, lives - 1))
        new[id] = (count + 1, left + 1)
    return new, [id for id in set(seen) if new[id][0] >= N]
""",
    ),
    (
        "09-end",
        "the end's place measured as range and bearing, as a landmark is placed",
        """
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j : 5 + 2 * j]
    c, s = np.cos(x[2] + beta), np.sin(x[2] + beta)
    away = rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha)
    r = away / np.cos(x[2] + beta - alpha)
    p = x[:2] + r * np.array([c, s])
    J = np.array([[1, 0, -r * s], [0, 1, r * c]])
    Jz = np.array([[c, -r * s], [s, r * c]])
    var_r = P[3 + 2 * j, 3 + 2 * j]
    C = J @ P[:3, :3] @ J.T + Jz @ np.diag([var_r, sigma**2]) @ Jz.T
    return p, C, J @ P[:3]
""",
    ),
    (
        "09-end",
        "sampled: a thousand ends drawn, and their spread",
        """
def end_point(x, P, j, beta, sigma):
    rng = np.random.default_rng(0)
    def meet(v, b):
        phi, a = v[2] + b, v[4 + 2 * j]
        r = (v[3 + 2 * j] - v[0] * np.cos(a) - v[1] * np.sin(a)) / np.cos(phi - a)
        return v[:2] + r * np.array([np.cos(phi), np.sin(phi)])
    many = rng.multivariate_normal(x, P, 1000)
    ends = np.array([meet(v, beta + sigma * rng.standard_normal()) for v in many])
    both = np.cov(np.column_stack([ends, many]).T)
    return meet(x, beta), both[:2, :2], both[:2, 2:]
""",
    ),
    (
        "09-ghosts",
        "the filter with a book: three sightings and ten lives, and what is left at the end",
        """
def clean_map(x, P, drives, C, scans, R, far):
    names, book, used, new = [], {}, set(), 0
    for t, scan in enumerate(scans):
        if t:
            x, P = predict(x, P, drives[t - 1], C)
        seen = []
        for z in scan:
            best = None
            for j, id in enumerate(names):
                rho, alpha = x[3 + 2 * j], x[4 + 2 * j]
                v = z - [rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha), alpha - x[2]]
                v[1] = wrap(v[1])
                cost = (v[0] / 0.4) ** 2 + (v[1] / 0.15) ** 2
                if cost < 1 and (best is None or cost < best[0]):
                    best = cost, j
            if best is None:
                x, P = add(x, P, z, R)
                names.append(new)
                seen.append(new)
                new += 1
            else:
                x, P = update(x, P, z, best[1], R)
                seen.append(names[best[1]])
        book, now = keep_book(book, seen, 3, 10)
        used |= set(now)
    keep = [j for j, id in enumerate(names) if id in used and id in book]
    return np.array([[x[3 + 2 * j], x[4 + 2 * j]] for j in keep]).reshape(-1, 2)
""",
    ),
]
