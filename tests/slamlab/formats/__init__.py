"""Formats of the world's files: each is read rightly or refused with line and remedy."""
