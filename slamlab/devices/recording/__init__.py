"""Raw recordings of devices, with a timestamp for every byte, and their playback (replay).

Read in this order:

- ``recording_file``: file format; ``recorder``: writes recordings
- ``decoding``: decodes scans and statuses
- ``playback``: replays a recording as emulated devices
"""

from slamlab.devices.recording.recorder import Recorder
from slamlab.devices.recording.recording_file import FORMAT, Recording, RecordingError, load

__all__ = ["FORMAT", "Recorder", "Recording", "RecordingError", "load"]
