"""What tools/evaluate-robot-link is made of: the link that can be interrupted, the logs of its two ends, the processes, and the trial."""
