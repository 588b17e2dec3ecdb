"""RPLIDAR and eMIR: ports, protocols, drivers, and a source of readings made of both."""
