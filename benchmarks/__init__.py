"""Measurements of time against other software: `make bench`, or python -m benchmarks [--quick] [--record FILE]."""
