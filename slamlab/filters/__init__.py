"""Filters, from the linear Kalman filter to the map-augmented one (EKF-SLAM)."""
