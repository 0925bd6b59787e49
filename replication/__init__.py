"""What the report computed, re-run in IEEE doubles, and the audit of every number it prints."""
