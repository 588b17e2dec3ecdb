"""Code similarity (plagiarism detection as in MOSS): find submissions of a class that share rare
code. Read in this order:

- ``code_tokens``: tokens that renaming and comments do not change, and their k-grams
- ``class_similarity``: rank pairs by the rarity of their shared code; compare two side by side
- ``similarity_report``: compare the stored submissions of a gradebook
"""
