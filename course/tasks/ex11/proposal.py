TASK = "11-proposal"
