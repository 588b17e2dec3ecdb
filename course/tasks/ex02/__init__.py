"""Programs of exercise 02, sensors and worlds."""
