"""Programs of exercise 08: right ways through its tasks, and mistakes."""
