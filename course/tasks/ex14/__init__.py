"""Programs of exercise 14, the eMIR system: right ways, slips, stumbles; ``sweep_ways`` is long."""
