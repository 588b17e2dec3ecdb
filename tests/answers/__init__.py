"""Independent answers: written from the lesson and the exercise's text alone, the checks unopened.

A module ``exNN.py`` holds ``RIGHT`` and ``WRONG``, lists of (task's id, what it is, source).
Nothing in the checks may be tuned to a single one of them; what they show is how well kinds of
mistakes are found. ``python -m tests.answers 06`` prints what the checks say of each.
"""
