"""A pose graph of scans: each scan is matched only with the last keyframe, and loops are closed."""

from course.project.solution import MySlam, Target


class ScanGraph(MySlam):
    """The solution without a local map, so that drift before loop closures is larger."""

    def _add_keyframe(self, cloud):
        super()._add_keyframe(cloud)
        last = len(self._poses) - 1
        self._local = Target(self._poses, self._clouds, [last])
