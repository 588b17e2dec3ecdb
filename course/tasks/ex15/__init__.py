"""Right ways and slips of exercise 15, closing the loop; a module for each task of ``tasks/ex15``."""
