"""Monte Carlo studies: tables of many runs; most modules are commands that write one.

- ``consistency`` (with ``ideal_filter``): NEES of EKF-SLAM; ``boxes``: BOR's guarantee
- ``walls``: Smolec's SLAM by its parts; ``feet``: his listing, and what its verdict hangs on
- ``wall_loop``: that SLAM in small, for lesson 09; ``spoilt_walls``: the loop with one part spoilt;
  ``corridor``: walls measured, and feet of walls; ``heard_walls``: walls by ultrasound;
  ``line_truth``: lines against the true walls
- ``three``: BOR, MAK, Monte Carlo, with ``three_records`` of each drive, ``three_rows`` of its
  table, ``three_costs``; ``three_pictures``: what lesson 12 shows of a drive
- ``samples``: how many samples find a robot, and maps by samples, with ``sampled_room``,
  ``sampled_rail``, ``sets_apart``, the experiments of lesson 11
- ``two_halves``, ``halves_in_turn``, ``agreeing_poses``: the laps of lesson 05, run where they
  stand
- ``broken_slam``: EKF-SLAM with one thing wrong, for lesson 06; ``broken_bounds``: BOR with a bound
  broken, and beside EKF-SLAM, for lesson 10
- ``shared_errors``, ``forgetting``, ``observability``: the experiments of lesson 07
- ``found_walls``: recall and false metres of line extraction, ``walls_on_trial``: which walls enter
  a map, both for lesson 08
- ``small_errors``: what a Jacobian foretells, and what a wrong one does, in lesson 04
- ``emir_trials``: bytes, looks and counters of the emulated devices, ``printed_drivers``: drivers
  as they are printed, both for lesson 14
- ``wheel_graphs``, ``edge_frames``, ``false_loops``: pose graphs, their edges and their loops on
  trial, for lesson 15
- ``intel_maps``: the maps of a real log that lessons 01, 13 and 15 show; ``a2_at_rest``: statistics
  of a real lidar, for lesson 02
- ``arena_logs``: the six data sets as files; ``paired_statistics``, ``study_command``: what they
  share
"""
