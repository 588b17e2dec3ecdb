"""Beliefs as clouds of weighted samples: localisation, the thesis' sets, FastSLAM (5.3)."""
