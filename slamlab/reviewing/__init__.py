"""A class's marks in a page of this machine: looked at, changed by hand, with a reason.

Read in this order:

- ``class_state``: what the gradebook holds, kept in memory, and what others added to it meanwhile
- ``class_overview``, ``submission_view``, ``likeness_view``: the table, one submission beside its
  verdict, and two side by side, as plain data
- ``hand_changes``: points, comments and answers by hand: rows of the ledger
- ``requests_file``, ``request_cells``, ``taking_requests``: requests for another look, from a CSV
  or from notebooks
- ``visible_text``: letters that nobody sees are shown
- ``review_routes``: the routes behind the guard of ``listening``, start and end

No HTML is made of anything that a student wrote: the page sets all of it as text.
"""
