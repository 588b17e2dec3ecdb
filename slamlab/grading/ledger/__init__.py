"""Ledger: every mark and every change, a row each, never rewritten, chained by hashes.

Read in this order:

- ``chains``: the rows, their hashes, and how one is appended
- ``chain_merging``: two ledgers in one; ``forgotten_students``: what is deleted when one of them
  asks for it
- ``contents``: notebooks' cells and workers' outputs, kept compressed by their hashes
- ``sightings``: in which order the judge first saw what was handed in
- ``ledger_book``: a ledger in a database
- ``chain_proof``: whether a row was altered; ``score_proof``: whether the judge says the same again
"""
