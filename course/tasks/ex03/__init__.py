"""Programs of exercise 03: right ways through its tasks, and mistakes."""
