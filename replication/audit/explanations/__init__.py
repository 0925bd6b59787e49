"""What would explain a number that does not follow: nothing here is asserted, all is tried."""
