"""A contest: a class's own SLAMs on one set of worlds that nobody has seen, and a board of them.

Read in this order:

- ``commitment``: what is drawn, told by its hash before and revealed after
- ``contest_logs``: recorded logs beside the worlds, found by their hashes
- ``sandbox_judging``: a student's class in a worker, one reading at a time
- ``drive_files``: what was driven, kept so that a contest goes on where it was left
- ``class_judging``: all students in all worlds; ``holding``: a contest from folder to board
- ``ranking``: scores with intervals, ranks with ties; ``pseudonyms``
- ``open_board``: what shows while a contest is open, by the Ladder
- ``moments``: where an estimate left its band; ``pictures``: the map of it, a film
- ``scoreboard``: the board, its tables, a page a student
"""
