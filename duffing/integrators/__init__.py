"""Integrators: the paper's Runge-Kutta with constant step, and the adaptive one in friction time (`friction_time`).

Both carry many trajectories side by side, a *lane* each. Reading order:

    solution       what every integrator returns
    powers         |v|^q for one fixed q by table and polynomial
    rk4            the paper's algorithm: `stage` is one stage of the textbook's scheme
    forcing        which members go into one block, and their table of cos(omega t)
    companion      lambda_1 from two trajectories, by the same steps

What they are written in, vectors of eight doubles and the block that the lanes live in, is the package `vectorized`.

**The same bits.** All that feeds back into a solution is spelled out in operations that IEEE 754 fixes, so a result of
`rk4` is the same on any machine, for any number of lanes, threads and workers. In friction time a member's bits do not
depend on its company either; where it creeps, and where tangent vectors are made orthonormal, the C library's pow, exp,
log and hypot are called (`radau`, `scheduler.creep`, `tangent_frame`), which may differ between machines.
"""
