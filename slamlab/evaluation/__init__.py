"""How good an estimate is: against the truth, against published relations."""
