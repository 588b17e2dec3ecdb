"""Motion and measurement (observation) models, their Jacobians and noise covariances.

Read in this order:

- ``motion``: motion models f; ``observation``: measurement models h, inverse measurement models g
- ``jacobians``: A and W of f, H of h, J_xr and J_z of g
- ``noise``: control noise C, process noise Q, measurement noise R
- ``parameters``: noise and limits of a robot and of a range sensor
- ``symbolic``: derivations by SymPy; ``finite_differences``: numerical Jacobians
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".motion": ["f_odometry", "f_steered"],
        ".observation": ["h", "g", "h_line", "g_line"],
        ".jacobians": [
            *("A_odometry", "W_odometry", "A_steered", "W_steered", "H_robot", "H_landmark"),
            *("J_xr", "J_z", "H_robot_line", "H_line", "J_xr_line", "J_z_line"),
        ],
        ".noise": ["C_odometry", "C_wheels", "Q", "R"],
        ".parameters": ["RobotModel", "SensorModel"],
    },
)
