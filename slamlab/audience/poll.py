"""A question put to the class: choices or a number; votes and a show of hands; counts come out."""

import math

import numpy as np

MOST_CHOICES, MOST_HANDS, MOST_BARS, LARGEST = 8, 10_000, 8, 1e12


class Poll:
    """A question that is open until it is closed; then the class sees the counts.

    Parameters
    ----------
    number : int, which poll of the lecture it is
    question : str, the notebook's name of it
    text : str, sanitised HTML
    choices : list of str, sanitised HTML, or None where a number is asked for
    unit : str, of the number, plain text

    Raises
    ------
    ValueError : one choice, or too many
    """

    def __init__(self, number, question, text, choices, unit=""):
        if choices is not None and not 2 <= len(choices) <= MOST_CHOICES:
            raise ValueError(f"a poll has 2 to {MOST_CHOICES} choices")
        self.number, self.question = number, question
        self.text, self.choices, self.unit = text, choices, unit
        self.is_open = True
        self._hands = [0] * len(choices or ())
        self._votes = {}  # of each client one, which it may change

    def vote(self, client, answer):
        """Take a client's vote in the place of its last one.

        Parameters
        ----------
        client : str
        answer : int, a choice's position; or a finite number

        Raises
        ------
        ValueError : it is neither, or the poll is closed
        """
        if not self.is_open:
            raise ValueError("the poll is closed")
        if isinstance(answer, bool) or not isinstance(answer, int | float):
            raise ValueError("a vote is a number")
        if self.choices is None:
            # an integer may be too large for a float
            if not abs(answer) <= LARGEST or not math.isfinite(answer):
                raise ValueError("a vote is a finite number")
            answer = float(answer)
        elif not isinstance(answer, int) or not 0 <= answer < len(self.choices):
            raise ValueError("there is no such choice")
        self._votes[client] = answer

    def vote_of(self, client):
        """The vote of a client: int, float or None."""
        return self._votes.get(client)

    def raise_hands(self, hands):
        """Take the lecturer's count of hands in the place of the last one.

        Parameters
        ----------
        hands : list of int, for each choice

        Raises
        ------
        ValueError : not as many as choices, or no counts
        """
        fits = isinstance(hands, list) and len(hands) == len(self._hands)
        if not fits or not all(type(n) is int and 0 <= n <= MOST_HANDS for n in hands):
            raise ValueError(f"give the hands of each choice, 0 to {MOST_HANDS}")
        self._hands = hands

    def counts(self):
        """What has been answered, without who.

        Returns
        -------
        dict : ``answers``, int; for choices ``counts``, list of int, and of them ``hands``; for a
            number ``bars``, list of {from, to, count}, whose first and last hold what lies farther
            out, and ``quartiles``, list of three numbers, empty without votes
        """
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
    # a few wild numbers must not press all others into one bar
    low, high = np.quantile(votes, [0.05, 0.95])
    if low == high:
        return [{"from": min(votes), "to": max(votes), "count": len(votes)}]
    number = min(MOST_BARS, len(set(votes)))
    heights, edges = np.histogram(np.clip(votes, low, high), number, (low, high))
    return [
        {"from": float(start), "to": float(end), "count": int(count)}
        for start, end, count in zip(edges[:-1], edges[1:], heights, strict=True)
    ]
