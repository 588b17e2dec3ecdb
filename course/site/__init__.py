"""Site of the course: lessons, exercises and guides as pages, made of what notebooks store."""
