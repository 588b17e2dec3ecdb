"""Hypothesis without deadlines and without chance: a test's verdict hangs on the code alone."""

from hypothesis import settings

settings.register_profile("slamlab", deadline=None, derandomize=True, max_examples=60)
settings.load_profile("slamlab")
