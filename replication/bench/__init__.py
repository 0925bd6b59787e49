"""Speed against error of this project's methods and of the alternatives, in one run."""
