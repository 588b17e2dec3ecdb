"""Programs of exercise 10: right ways, slips and stumbles of each task."""
