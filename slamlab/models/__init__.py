"""Motion and observation models, their Jacobians, their noise covariances, and their derivation.

Read in this order:

- ``motion``: f, the motion models; ``observation``: h, the observation models, and g, their inverse
- ``jacobians``: A and W of f, H of h, J_xr and J_z of g (a new landmark)
- ``noise``: C of the control, Q of the process noise, R of the measurement noise
- ``parameters``: noise and limits of a robot and of a range sensor
- ``symbolic``: all of it derived by sympy; tests hold sympy = code = finite differences
- ``differences``: slopes of any model, to hold its Jacobian against
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
