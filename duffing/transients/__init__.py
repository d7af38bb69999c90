"""Transient chaos: lifetimes and the crisis that ends or begins it."""
