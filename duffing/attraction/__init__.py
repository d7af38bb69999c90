"""Attractors, their basins and the boundaries between them; transient chaos and its end."""
