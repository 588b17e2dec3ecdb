"""Device emulators for RPLIDAR and eMIR: state machines fed bytes and time, and their ports.

Read in this order:

- ``robot_body``: the robot in its world; ``scan_head``, ``motion_distortion``: what its lidar sees
- ``rplidar_emulator`` (with ``packet_encoder``), ``emir_emulator``: the state machines
- ``serial_line``, ``fault_injection``: bytes delayed, lost, corrupted
- ``pseudo_terminal``, ``tcp_server``: the ports; ``emulator_runner``: the thread that runs it all
- ``memory_emulators``: the same without ports, in simulated time
- ``synthetic_recording``: a drive recorded in simulated time
"""
