"""Emulated devices: state machines that are fed bytes and the time, and front ends for them."""
