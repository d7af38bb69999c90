"""The computations behind the chapters: a chapter's module bears its name.

Shared by several: `reproduction` (the paper's figures by its own algorithm) and `accuracy` (which integrator, how
exact); `transients` and `window` (lifetimes and the ends of the window), `wandering` and `comparison` (exponents).
"""
