"""Transient chaos: lifetimes, survival and the crisis that ends or begins it."""
