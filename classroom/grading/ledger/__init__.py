"""Audit ledger: an append-only log of attempts and changes, chained by hashes. Read in this order:

- ``chains``: rows, their hashes, and appending; ``chain_merging``: merge two ledgers
- ``student_erasure``: delete a student's data on request
- ``contents``, ``content_store``: compressed cells and outputs, stored under their hashes
- ``submission_order``: the order in which the judge first read submissions
- ``ledger_book``: a ledger in a database; ``chain_verification``: detect altered rows
- ``score_verification``: reproduce scores
"""
