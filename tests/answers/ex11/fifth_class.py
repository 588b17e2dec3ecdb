"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "11-proposal",
        "the heading before is not wrapped off",
        """
def reweigh(before, after, weights, u, C, m, D):
    step = after - before
    d = step[:, 0] * np.cos(before[:, 2]) + step[:, 1] * np.sin(before[:, 2])
    us = np.column_stack([d, step[:, 2]])
    def log(v, S):
        S = np.broadcast_to(S, (len(v), 2, 2))
        return -0.5 * np.einsum("ni,nij,nj->n", v, np.linalg.inv(S), v) - 0.5 * np.log(np.linalg.det(S))
    return normalise(np.log(weights) + log(us - u, C) - log(us - m, D))
""",
    ),
    (
        "11-localise",
        "effective size of less than half of one",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < 0.5:
        rows, weights = rows[draw(weights, rng)], np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
]
