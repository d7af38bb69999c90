"""What numba lacks for many trajectories side by side; it knows nothing of oscillators.

vectors        eight doubles as one number, the arithmetic that all kernels are written in
memory         the block that the lanes live in, and views of its parts: `view[ROW, c]`, eight lanes at once,
               or `view[ROW, l]`, one lane
compiled       where compiled code is kept, and until when
processors     how many threads serve a process
"""
