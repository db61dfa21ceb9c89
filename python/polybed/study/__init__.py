"""What studies of finished runs share: means over time with their intervals, and what runs have measured."""
