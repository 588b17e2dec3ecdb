"""x"""
TASK = "12-lost"
WAYS = {}
