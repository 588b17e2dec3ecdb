"""Times as people read them: on the clocks of the course."""

from datetime import UTC, datetime


def local_time(when, zone=None, named=False):
    """A time on the clocks of a zone, such as 2026-12-01 23:59; empty for none.

    Parameters
    ----------
    when : datetime, str in ISO's form, or None
    zone : ZoneInfo or None, for UTC
    named : bool, whether the zone's name follows, as where readers may be elsewhere

    Returns
    -------
    str
    """
    if not when:
        return ""
    moment = datetime.fromisoformat(when) if isinstance(when, str) else when
    return f"{moment.astimezone(zone or UTC):{'%Y-%m-%d %H:%M %Z' if named else '%Y-%m-%d %H:%M'}}"
