"""The adaptive integrator: order eight, in friction time where the damping is not smooth, creep and stick included.

Reading order:

    equations        the equations of motion in a variable that makes every crossing of v = 0 smooth
    block            the parts of a block of lanes, and their rows, as a table
    dop853           one explicit step of all lanes; tests/test_dop853.py begins with one lane, one step
    step_control     accepted or not, how long the next one is, and what else there is to do (OUTCOME)
    event_location   exact arrival at a time or at a turning point
    radau            one implicit step of one lane, where the mass creeps
    tangent_frame    the tangent vectors of one lane made orthonormal
    scheduler        which lane does what: `run_lanes`
    batches          members in batches over threads, and the names of failures
    adaptive, turning_points   the two front ends

The life of a lane (`scheduler`): `load_member` gives it a trajectory, `start_interval` the next time to reach, and
`first_slopes` the slopes where it is. Then, again and again, all lanes of the block attempt a step (`dop853.step`) and
accept it or not (`step_control.accept_steps`). A lane whose OUTCOME is not GOING is served alone, between two steps
(`handle_event`): it ARRIVES (`locate_event`, until the event is met exactly), it CREEPS (`creep`, by `radau_step`), its
tangent vectors COLLAPSE (`orthonormalise`), or it has failed. At the end of an interval `store` writes the results;
after the last the lane takes up the next member, or gives its place to the last lane of the block.

A lane's bits depend on nothing in the others. What a creep computes, and the growth of tangents, goes by the C
library's pow, exp, log and hypot: there the bits may differ between machines.
"""
