"""What the stages say to each other: the values, the topics they travel on, and their bytes."""
