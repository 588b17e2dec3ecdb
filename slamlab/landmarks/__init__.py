"""Landmarks from scans: spikes, walls' lines, corners; which were seen before, which live on."""
