"""Programs of exercise 12, three filters and one robot."""
