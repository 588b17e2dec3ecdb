"""x"""
TASK = "12-paired"
WAYS = {}
