"""Tests of the library, which need the library and pytest, and state what else they need."""
