"""The course's text sources and the build tool that derives (generates) its notebooks from them."""
