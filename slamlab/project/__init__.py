"""The final project: a student's own SLAM, driven through rooms nobody has seen, and scored.

Read in this order:

- ``floors``, ``tours``, ``furniture``: a floor plan, a walk through it, what stands in it
- ``world_families``: what worlds have in common; ``hidden_worlds``: HiddenWorld, its readings and
  its truth; ``drawing``: draw_world, draw_family
- ``recorded_logs``: logs with relations, which a lecturer may add
- ``driving``: drive a student's estimator, held at arm's length, within a Budget
- ``reading_arrays``, ``streamed_drive``: the same through a pipe, one reading a message
- ``drive_errors``: relative errors, map score, NEES; ``points``: the published scale
- ``baselines``: the package's estimators, which are its marks; ``scores``: arenas, judge, score
- ``practice``: public worlds to practise in, a table and a drawing
"""
