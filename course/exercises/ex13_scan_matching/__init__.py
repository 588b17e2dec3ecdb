"""Exercise 13: its notebook, questions and function calls, and a folder for each task."""
