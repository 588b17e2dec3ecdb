TASK = "11-localise"
