"""Pure functions on points and arrays."""
