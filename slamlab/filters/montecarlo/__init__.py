"""Particle filters: Monte Carlo localisation, sample sets, FastSLAM (MAK thesis, 5.3).

Read in this order:

- ``weights``, ``resampling``, ``particles``: importance weights, resampling, sets of particles
- ``motion_sampling``: proposal from the motion model; ``likelihood``: observation likelihoods
- ``mcl``: localisation in a known map
- ``sample_sets``: SLAM with a set for the robot and one for each landmark; ``fastslam``
- ``particle_association``, ``observation_checks``: data association, checks of arguments
"""
