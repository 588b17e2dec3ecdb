TASK = "11-kidnapped"
