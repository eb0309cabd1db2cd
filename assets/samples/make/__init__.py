"""The script that makes the reference drawings and their ground truths.

Their trajectories are data: files beside the drawings, that no script writes.
"""
