"""The error of the sheet and of the closed form, against the exact motion."""
