"""Numerical kernels that several filters share."""
