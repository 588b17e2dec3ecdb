"""Raw recordings (logs) of devices: every byte with its timestamp; read, replayed, played back.

Read in this order:

- ``recording_file``: the format; ``recorder``: writing it while programs use the ports
- ``decoding``: scans and statuses out of it; ``request_response``: what was asked and answered
- ``replay_port``: a recording as a port; ``playback``: as devices that answer requests
"""

from slamlab.devices.recording.recorder import Recorder
from slamlab.devices.recording.recording_file import FORMAT, Recording, RecordingError, load

__all__ = ["FORMAT", "Recorder", "Recording", "RecordingError", "load"]
