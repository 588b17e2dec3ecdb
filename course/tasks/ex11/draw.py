TASK = "11-draw"
