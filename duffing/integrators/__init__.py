"""Integrators: the paper's Runge-Kutta with constant step, and the adaptive one in friction time (`friction_time`)."""
