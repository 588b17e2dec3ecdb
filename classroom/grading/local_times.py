"""Format times for readers in the time zone of the course."""

from datetime import UTC, datetime


def local_time(when, zone=None, named=False):
    """Format a time such as 2026-12-01 23:59 in a time zone (None: UTC); "" for None."""
    if not when:
        return ""
    time = datetime.fromisoformat(when) if isinstance(when, str) else when
    time = time.astimezone(UTC).astimezone(
        zone or UTC
    )  # by UTC, because a clock may skip the given time
    return f"{time:{'%Y-%m-%d %H:%M %Z' if named else '%Y-%m-%d %H:%M'}}"
