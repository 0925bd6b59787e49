"""What is known: the report's printed numbers, and its equations to any precision."""
