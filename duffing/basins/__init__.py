"""Attractors and their basins: how they are found, captured, drawn, and how uncertain their boundaries are."""
