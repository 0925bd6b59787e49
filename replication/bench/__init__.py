"""Speed against error: this project's methods and what others would use instead, in one run."""
