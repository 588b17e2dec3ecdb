"""Programs of exercise 13, scan matching."""
