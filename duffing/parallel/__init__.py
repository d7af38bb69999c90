"""What `sweep` stands on: workers, checkpoints, progress, and what a task costs."""
