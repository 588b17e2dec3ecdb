"""Right ways and slips of exercise 09."""
