"""Families over cores or a cluster: blocks, executors, progress, checkpoints."""
