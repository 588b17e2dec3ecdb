"""Likeness: who shares with whom what is rare in a class; a hint where to look, not a verdict.

Read in this order:

- ``code_tokens``: code as tokens that renaming and comments do not change, and its k-grams
- ``handed_out``: k-grams of what everybody was given
- ``class_likeness``: pairs ranked by the rarity of what they share, and two side by side
- ``kept_submissions``: the likeness of what a gradebook keeps
"""
