"""Motion of the laser in a ROS bag, from the odometry topic or from transforms (tf), if any."""

from collections import Counter
from itertools import pairwise

import numpy as np

from slamlab.files import SourceError
from slamlab.sources.ros_messages import NOT_FINITE
from slamlab.sources.ros_pose_interpolation import MAX_CLIMB, ROW, PoseSeries
from slamlab.sources.ros_tf_tree import (
    WORLD_FRAMES,
    Motion,
    TransformTree,
    is_body,
    is_odometry,
    last_name,
    motion,
)
from slamlab.sources.ros_time_synchronisation import Stamps

# kind of damage: tf lacks the mounting (extrinsics) of the laser
NO_TRANSFORM = "no transform to the laser, which is assumed at the robot's centre"
BASES = ("base_footprint", "base_link")  # frames of a robot's body by convention
IN_THE_PLANE = "x and y of its frames must be in the ground plane"


class LaserMotion:
    """Motion of the lasers from the Messages of a bag; also fills ``damage`` and ``notes``."""

    def __init__(self, messages):
        self.messages, self.damage, self.notes = messages, Counter(), []
        self._tree = TransformTree(messages.moving, messages.fixed)
        self._odometry = self._usual_odometry()

    def of_scans(self, after=0.0):
        """Return the Motion at all scans; its poses are None without odometry. Raises SourceError.

        ``after`` is added to the timestamps of the scans, scalar or (n,) [s].
        """
        frames = np.array(self.messages.frames)
        stamps = Stamps(
            np.array(self.messages.stamps) + after, np.array(self.messages.received) + after
        )
        names = dict.fromkeys(self.messages.frames)
        found = [(name, frames == name, self._of(name, stamps[frames == name])) for name in names]
        if len(found) == 1:
            return found[0][2]
        if any(part.poses is None for *_, part in found):
            what = f"{self.messages.topic} has scans of several frames ({', '.join(names)})"
            raise SourceError(f"{what} without odometry. Record each lidar on its own topic")
        whole = Motion.empty(len(frames))
        for _, mask, part in found:
            for name in ("poses", "covered", "tilted", "upside_down"):
                getattr(whole, name)[mask] = getattr(part, name)
            whole.interval = whole.interval or part.interval
        return whole

    def _of(self, laser, stamps):
        """Return the Motion of a laser's frame at times (Stamps)."""
        self._note(*self._tree.notes(laser))
        self._count_unusable(laser)
        factors = self._by_topic(laser) or self._by_transforms(laser) or self._by_body(laser)
        found = self._static(laser, stamps) if factors is None else motion(factors, stamps)
        self._note(*found.notes)
        return found

    def _by_topic(self, laser):
        """Return the factors (transforms) of the laser's pose from the odometry topic, or None."""
        topic, unused = self.messages.odometry_topic, "is not used"
        if self._odometry is None:
            if topic is not None:
                self._note(f"odometry {topic} {unused}: {self._unusable()}")
            return None
        frame, child, poses = self._odometry
        if not self._usable(poses):
            return None
        body = child
        if not child or child == frame or is_odometry(child) or last_name(child) in WORLD_FRAMES:
            body = self._body(laser)  # some drivers leave it empty or set a wrong one
        mount = self._tree.resolve(body, laser)
        if mount is None and self._by_transforms(laser):
            self._note(f"odometry {topic} {unused}: no transform leads from {body} to {laser}")
            return None
        if mount is None or body == laser != child:
            mount = self._part_of_mount(child or "the robot", laser)
        return [(poses, False), *mount]

    def _by_transforms(self, laser):
        """Return the factors of the laser's pose from the transforms (tf) alone, or None."""
        chain = [n for n in self._tree.ancestors(laser) if last_name(n) not in WORLD_FRAMES]
        top = next((name for name in chain if is_odometry(name)), chain[-1])
        moving = [name for name in chain[: chain.index(top)] if self._tree.moves(name)]
        # a moving frame below the robot's body is a joint
        if not moving or not (is_odometry(top) or is_body(moving[-1])):
            return None
        usable = all([self._usable(poses) for poses in self._tree.moving_links(laser, top)])
        return self._tree.resolve(top, laser) if usable else None

    def _by_body(self, laser):
        """Return the factors from the body's transforms if no transform leads to the laser."""
        parents = self._tree.parents
        bodies = [name for name in parents if is_odometry(parents[name]) and self._tree.moves(name)]
        if self._odometry or len(bodies) != 1 or bodies[0] in self._tree.ancestors(laser):
            return None
        path = self._tree.resolve(parents[bodies[0]], bodies[0])
        if not self._usable(path[0][0]):
            return None
        return [*path, *self._part_of_mount(bodies[0], laser)]

    def _part_of_mount(self, body, laser):
        """Return the known factors of the laser's mounting (extrinsic calibration); add a note."""
        self.damage[NO_TRANSFORM] = 1
        self._note(f"no transform leads from {body} to {laser}; record /tf and /tf_static as well")
        top = self._body(laser)
        return self._tree.resolve(top, laser) if is_body(top) else []

    def _usable(self, poses):
        """Return whether odometry can be used; if not, add a note. SourceError: not planar."""
        if poses.climb > max(MAX_CLIMB, poses.extent):
            along = f"moves {poses.climb:.4g} m along z and {poses.extent:.4g} m in the plane"
            raise SourceError(f"odometry ({poses.name}) {along}; {IN_THE_PLANE}")
        why = ""
        if poses.has_two_publishers():
            why = "its poses jump back and forth, as if two nodes published them; use one node"
        elif poses.stands_still():
            why = "its pose never changes; check the encoders, and whether the driver sets it"
        if why:
            self._note(f"odometry {poses.name} is not used: {why}")
        return not why

    def _static(self, laser, stamps):
        """Return a Motion without poses: only the laser's mounting on the robot is known."""
        body = self._body(laser)
        why = f"no transform gives the motion of {laser}"
        if len(self._tree.ancestors(body)) > 1:
            parent = self._tree.parents[body]
            moves = "is a correction, not odometry" if self._tree.moves(body) else "never changes"
            why = f"the transform {parent} → {body} {moves}"
        if self.messages.odometry_topic is None:
            why = f"there is no topic of nav_msgs/Odometry, and {why}"
        self._note(f"the scans are read without odometry, because {why}")
        found = motion(self._tree.resolve(body, laser), stamps)
        found.poses = None
        return found

    def _body(self, laser):
        """Return the robot's frame to which a laser is fixed."""
        chain = self._tree.ancestors(laser)
        for name, parent in pairwise(chain):
            world = is_odometry(parent) or last_name(parent) in WORLD_FRAMES
            if name in BASES or world or self._tree.moves(name):
                return name
        return chain[-1]

    def _usual_odometry(self):
        """Return the frames and PoseSeries of the commonest kind of odometry message, or None."""
        rows = self.messages.odometry
        if not rows:
            return None
        frame, child = max(rows, key=lambda key: len(rows[key]))
        others = sum(len(each) // ROW for key, each in rows.items() if key != (frame, child))
        if others:
            self.damage["odometry messages of another frame"] += others
        topic = self.messages.odometry_topic
        return frame, child, PoseSeries(topic, np.array(rows[frame, child]).reshape(-1, ROW))

    def _unusable(self):
        """Return the fault of odometry without a usable message."""
        faults = self.messages.unusable.get(None)
        if not faults:
            return "none of its messages can be read"
        kind, count = faults.most_common(1)[0]
        field = "position" if kind == NOT_FINITE else "orientation"
        return f"{count} messages have {kind} in pose.pose.{field}; correct the driver"

    def _count_unusable(self, laser):
        """Count the faults of odometry and of transforms to a laser."""
        for kind, count in self.messages.unusable.get(None, {}).items():
            self.damage[f"odometry with {kind}"] = count
        for name in self._tree.ancestors(laser):
            for kind, count in self.messages.unusable.get(name, {}).items():
                self.damage[f"transforms to {name} with {kind}"] = count
        for parent, child in sorted(self.messages.changed):
            if child in self._tree.ancestors(laser):
                self._note(f"{parent} → {child} has several static transforms; the last is used")

    def _note(self, *sentences):
        self.notes += [each for each in sentences if each not in self.notes]
