"""Right ways and slips of exercise 06, EKF-SLAM."""
