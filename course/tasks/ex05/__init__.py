"""Right ways and slips of exercise 05, two easy halves."""
