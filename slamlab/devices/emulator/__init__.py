"""Device emulators of RPLIDAR and eMIR: protocol state machines and their ports.

Read in this order:

- ``emulated_robot``: robot in its world; ``motion_distortion``, ``scan_sampling``: its lidar
- ``lidar_models``, ``packet_encoder``, ``rplidar_emulator``, ``emir_emulator``: state machines
- ``serial_line``, ``fault_injection``: delayed, lost and corrupted bytes
- ``pseudo_terminal``, ``tcp_server``: ports; ``emulator_runner``: thread
- ``in_memory_emulators``, ``synthetic_recording``: emulation without ports, in simulated time
"""
