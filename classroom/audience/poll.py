"""Poll: a multiple-choice or numeric question to the class, with votes, show of hands and
counts."""

import math

import numpy as np

MAX_CHOICES, MAX_HANDS, MAX_BARS, LARGEST = 8, 10_000, 8, 1e12


class Poll:
    """Question to the class; the class sees the counts when the poll is closed.

    question : the question's id in the notebook. text, choices : sanitised HTML; choices is None
    for a numeric question. Raises ValueError if there is only one choice, or if there are too many
    choices."""

    def __init__(self, number, question, text, choices, unit=""):
        if choices is not None and not 2 <= len(choices) <= MAX_CHOICES:
            raise ValueError(f"a poll must have 2 to {MAX_CHOICES} choices")
        self.number, self.question = number, question
        self.text, self.choices, self.unit = text, choices, unit
        self.is_open = True
        self._hands = [0] * len(choices or ())
        self._votes = {}  # one for each client, which may change it

    def vote(self, client, answer):
        """Count a client's vote, a choice's index or a finite number; else raise ValueError."""
        if not self.is_open:
            raise ValueError("the poll is closed")
        if isinstance(answer, bool) or not isinstance(answer, int | float):
            raise ValueError("a vote must be a number")
        if self.choices is None:
            # an integer may be too large for a float
            if not abs(answer) <= LARGEST or not math.isfinite(answer):
                raise ValueError("a vote must be a finite number")
            answer = float(answer)
        elif not isinstance(answer, int) or not 0 <= answer < len(self.choices):
            raise ValueError("the poll does not have this choice")
        self._votes[client] = answer

    def vote_of(self, client):
        return self._votes.get(client)

    def raise_hands(self, hands):
        """Set the number of raised hands for each choice; raise ValueError if a number is
        invalid."""
        fits = isinstance(hands, list) and len(hands) == len(self._hands)
        if not fits or not all(type(n) is int and 0 <= n <= MAX_HANDS for n in hands):
            raise ValueError(f"enter the number of hands for each choice, 0 to {MAX_HANDS}")
        self._hands = hands

    def counts(self):
        """Return the anonymous results, a dict.

        ``answers`` is the number of votes. A question with choices also has ``counts``, which
        include ``hands``; a numeric question has ``bars`` {from, to, count}, a histogram with round
        limits and a bar for the outliers at either end, and ``quartiles``."""
        votes = list(self._votes.values())
        if self.choices is None:
            return {"answers": len(votes), "bars": _bars(votes), "quartiles": _quartiles(votes)}
        counts = [votes.count(n) + hands for n, hands in enumerate(self._hands)]
        return {"answers": sum(counts), "counts": counts, "hands": self._hands}


def _quartiles(votes):
    return np.quantile(votes, [0.25, 0.5, 0.75]).tolist() if votes else []


def _bars(votes):
    if not votes:
        return []
    # outliers must not squeeze all other numbers into one bar
    low, high = np.quantile(votes, [0.05, 0.95])
    step = _round((high - low) / min(MAX_BARS - 3, len(set(votes))))
    edges = [low, high]
    if step > 1e-12 * max(abs(low), abs(high)):
        edges = step * np.arange(np.floor(low / step), np.ceil(high / step) + 1)
    edges = np.unique([*edges, min(*votes, edges[0]), max(*votes, edges[-1])])
    if len(edges) == 1:
        edges = np.repeat(edges, 2)
    heights, _ = np.histogram(votes, edges)
    return [
        {"from": float(start), "to": float(end), "count": int(count)}
        for start, end, count in zip(edges[:-1], edges[1:], heights, strict=True)
    ]


def _round(step):
    """Return 1, 2 or 5 times a power of ten, at least as large as a step."""
    if not step > 0:
        return 0.0
    power = 10.0 ** np.floor(np.log10(step))
    return next((m * power for m in (1, 2, 5) if m * power >= step), 10 * power)
