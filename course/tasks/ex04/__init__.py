"""Right ways through exercise 04 and the slips on them."""
