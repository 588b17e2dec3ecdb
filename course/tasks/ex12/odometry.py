"""x"""
TASK = "12-odometry"
WAYS = {}
