"""Which integrator for which exponent, and how accurate: one rule for all chapters.

Where the damping is smooth in v, p >= 1, the paper's fixed steps are exact enough and cheap. Below they are not (that
is what the chapter on small p is about), and the adaptive integrator takes over.
"""

# In chaos an orbit cannot be exact over long times: averages, labels and lifetimes have statistical errors far larger.
STATISTICS = {"rtol": 1e-6, "atol": 1e-8}
CURVES = {"rtol": 1e-8, "atol": 1e-10}


def integrator(p, tolerance=STATISTICS, steps_per_period=500):
    """Options of `duffing.flow.integrate` for the exponent p; the tolerance is that below p = 1, the steps are those
    from there on."""
    return {"method": "rk4", "steps_per_period": steps_per_period} if p >= 1 else tolerance
