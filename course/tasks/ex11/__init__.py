"""Right ways, slips and stumbles of exercise 11."""
