"""What is compiled inside the integrators `rk4` and `friction`: lanes, powers, steps, landings, creeps."""
