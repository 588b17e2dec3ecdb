"""Web site of the course: lessons, exercises and guides as pages, and the API reference."""
