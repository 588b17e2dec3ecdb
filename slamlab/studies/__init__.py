"""Monte Carlo studies: tables of many runs; each module is a command that writes one.

- ``consistency`` (with ``ideal_filter``): NEES of EKF-SLAM; ``boxes``: BOR's guarantee
- ``walls``: Smolec's SLAM by its parts; ``feet``: his listing, and what its verdict hangs on
- ``three`` (with ``three_costs``): BOR, MAK, Monte Carlo
- ``arena_logs``: the six data sets as files; ``study_command``: what the commands share
"""
