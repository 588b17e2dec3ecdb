"""The course's text sources and the tool that derives its notebooks from them."""
