"""BOR, the bounded filter: boxes that hold the truth as long as every noise is bounded."""

from slamlab.filters.bor.filter import BOR
from slamlab.filters.bor.sharpen import EmptyIntersection

__all__ = ["BOR", "EmptyIntersection"]
