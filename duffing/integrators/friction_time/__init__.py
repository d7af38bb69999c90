"""The adaptive integrator: order eight, in friction time where the damping is not smooth, creep and stick included."""
