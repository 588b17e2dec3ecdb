"""Right ways and slips of exercise 01, why SLAM; a module for each task of ``tasks/ex01``."""
