"""Tests of the course: its texts, tasks, studies, site and set-up."""
