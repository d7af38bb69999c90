"""Periodic orbits, followed through their folds, flips and symmetry breakings, and the diagrams they explain."""
