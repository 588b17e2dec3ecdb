"""x"""
TASK = "12-interval"
WAYS = {}
