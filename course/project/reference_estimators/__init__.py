"""Three other good estimators, such as students may submit; they test the point scale."""

from course.project.reference_estimators.grid_particles import GridParticles
from course.project.reference_estimators.scan_graph import ScanGraph
from course.project.reference_estimators.wall_ekf import WallEkf

BANK = (GridParticles, ScanGraph, WallEkf)
