"""x"""
TASK = "12-relocalise"
WAYS = {}
