"""Published recordings: fetched, copied, listed and checked."""
