"""Speed against error: every method and its peers on the same cases, in one run."""
