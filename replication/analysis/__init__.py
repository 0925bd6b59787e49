"""How far the sheet is from the exact solution, why, and where it stops making sense."""
