"""Audience response system: students' phones show the current slide and answer polls.

Read in this order: ``lecture_state``, ``poll``, ``sanitising``; ``phone_routes`` and
``lecturer_routes``, routes of the two servers; ``addresses``; ``server_start``, ``server``,
``__main__``."""

from slamlab._lazy import exports

__all__ = exports(__name__, {".server_start": ["start"]})
