"""Raw recordings: every byte from and to devices, with its time; read, replayed, played back."""

from slamlab.devices.recording.recorder import Recorder
from slamlab.devices.recording.records import FORMAT, Recording, RecordingError, load

__all__ = ["FORMAT", "Recorder", "Recording", "RecordingError", "load"]
