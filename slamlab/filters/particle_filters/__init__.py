"""Particle filters: Monte Carlo localisation, independent particle sets, FastSLAM (MAK 5.3).

Read in this order:

- ``importance_weights``, ``resampling`` and ``particle_set``: weighted particles
- ``motion_sampling``: the proposal distribution; ``likelihood``: likelihood of observations
- ``monte_carlo_localisation``: known map; ``independent_particle_sets``, ``fastslam``: SLAM
- ``particle_association``: data association by the covariance of the particles
"""
