"""Three other good estimators, as students might hand in: what the scale is tried with."""

from course.project.bank.grid_particles import GridParticles
from course.project.bank.scan_graph import ScanGraph
from course.project.bank.wall_ekf import WallEkf

BANK = (GridParticles, ScanGraph, WallEkf)
