"""Times of handing in that cannot be: a file's own time is anybody's."""

from dataclasses import replace
from datetime import datetime, timedelta

from slamlab.grading.term.lms_names import lms_name

FUTURE = timedelta(minutes=5)
"""By how much the clocks of two machines may differ."""


def without_future(found, listed, attempts, now):
    """Submissions whose time is yet to come, as handed in when they were first read.

    A student can set the time of a file, not that of an LMS or of nbgrader. The first time stands,
    so that grading again, also with all anew, makes nobody late who was not.

    Parameters
    ----------
    found : list of Submission
    listed : what :func:`batch.content_hashes` gave
    attempts : iterable of Record, all that are known, the oldest first
    now : datetime, with its zone

    Returns
    -------
    list of Submission
    """
    contents, first = dict(listed), {}
    for record in attempts:
        first.setdefault((record.submission, record.sha256), record.handed_in)
    made = []
    for each in found:
        by_others = each.has_trusted_time or (each.when is not None and lms_name(each.name))
        told = None if by_others else each.handed_in
        if told and datetime.fromisoformat(told) > now + FUTURE:
            when = first.get((each.name, contents.get(each.name)))
            if not when or datetime.fromisoformat(when) > now:
                when = now.isoformat()
            note = f"its time, {told[:16]}, was yet to come: counted as handed in when first read"
            each = replace(each, when=when, note=note)
        made.append(each)
    return made
