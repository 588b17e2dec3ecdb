"""Right ways through the tasks of exercise 07, and the slips on them."""
