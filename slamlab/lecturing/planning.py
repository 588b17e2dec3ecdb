"""Planned minutes of a lesson's sections: those it says, else its whole time spread by a rule."""

import re

TOTAL = re.compile(r"\*\*(\d+) min")


def total(head):
    """The minutes that a lesson's first cell promises, or None.

    Parameters
    ----------
    head : str, the cell's text, such as "… **100 minutes** (50 for …)"

    Returns
    -------
    int or None
    """
    match = TOTAL.search(head)
    return int(match[1]) if match else None


def planned(sections, whole):
    """Minutes of each section: as the lesson says, else spread by the stops it has.

    Parameters
    ----------
    sections : list of dict, each with ``minutes`` (0 where none are said) and ``stops``
    whole : int or None, the minutes of the lesson

    Returns
    -------
    list of int, in the sum ``whole`` where they are spread
    """
    said = [section["minutes"] or 0 for section in sections]
    if any(said) or not whole:
        return said
    stops = [section["stops"] for section in sections]
    ends = [round(whole * sum(stops[: k + 1]) / sum(stops)) for k in range(len(stops))]
    return [end - begin for begin, end in zip([0, *ends], ends, strict=False)]
