"""The saddle orbit and its manifolds: orbit, curves of W^S and W^U, splitting, tangency, correction, sticking."""
