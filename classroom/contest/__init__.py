"""A contest: students' SLAM programs on hidden worlds, and a leaderboard.

Read in this order: ``seed_commitment`` (a hash, published beforehand), ``contest_logs``;
``sandbox_judging``, ``run_files``, ``class_judging``; ``contest_run`` (from submissions to the
board); ``ranking``, ``student_pseudonyms``, ``open_leaderboard``; ``large_errors``, ``pictures``,
``leaderboard``."""
