TASK = "11-weigh"
