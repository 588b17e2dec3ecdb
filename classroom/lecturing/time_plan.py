"""Time plan of a lesson: minutes of its sections, given or distributed."""

import re

TOTAL = re.compile(r"\*\*(\d+) min")


def total_minutes(head):
    """Return the minutes stated in the text of a lesson's first cell, or None."""
    match = TOTAL.search(head)
    return int(match[1]) if match else None


def section_minutes(sections, total):
    """Return the minutes of each section: as given, or ``total`` distributed over the stops.

    sections : dicts with ``minutes`` (0 if none are given) and ``stops``."""
    given = [section["minutes"] or 0 for section in sections]
    if any(given) or not total:
        return given
    stops = [section["stops"] for section in sections]
    ends = [round(total * sum(stops[: k + 1]) / sum(stops)) for k in range(len(stops))]
    return [end - begin for begin, end in zip([0, *ends], ends, strict=False)]
