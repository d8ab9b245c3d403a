# SPDX-License-Identifier: Apache-2.0
"""The numbers of stylet.h that have a meaning, by their names there."""
import enum

NO_LAYER = 0xFFFFFFFF


class Status(enum.IntEnum):
    """Why something was refused."""
    OK = 0
    ORGAN_TOO_SMALL = 100
    ORGAN_NOT_AN_ORGAN_FILE = 101
    ORGAN_VERSION_UNKNOWN = 102
    ORGAN_STRUCTURE_DAMAGED = 103
    ORGAN_VALUE_OUT_OF_RANGE = 104
    ORGAN_INDEX_OUT_OF_RANGE = 105
    ORGAN_SIZES_DISAGREE = 106
    ORGAN_ORDER_WRONG = 107
    ORGAN_TOO_LARGE = 108
    CONFIG_VALUE_OUT_OF_RANGE = 200
    OBSTACLES_TOO_LATE = 201
    MEMORY_TOO_SMALL = 300
    MEMORY_NOT_ALIGNED = 301
    SNAPSHOT_DOES_NOT_MATCH = 302
    SNAPSHOT_DAMAGED = 303
    ARGUMENT_MISSING = 400
    STRUCT_SIZE_UNKNOWN = 401
    OUT_OF_MEMORY = 402
    FILE_UNREADABLE = 403
    CONTENT_DAMAGED = 404
    ARGUMENT_OUT_OF_RANGE = 405
    DEVICE_FAILED = 406
    LOOP_RUNS = 407


class Phase(enum.IntEnum):
    """Where the tip is."""
    FREE = 0
    CONTACT = 1
    INSERTED = 2
    RETRACTING = 3


class Flag(enum.IntFlag):
    """What was wrong in a tick. FAULT stays until a reset, and there is no force meanwhile."""
    INPUT_NOT_FINITE = 1 << 0
    INPUT_CLAMPED = 1 << 1
    INPUT_MISSING = 1 << 2
    CP_POOL_FULL = 1 << 3
    CP_VOXEL_POOL_FULL = 1 << 4
    CONTACT_BUDGET = 1 << 5
    OBSTACLE_POOL_FULL = 1 << 6
    NEEDLE_UNSTABLE = 1 << 7
    FAULT = 0x80000000


class Event(enum.IntEnum):
    """What happened to a needle."""
    CONTACT = 0
    RELEASE = 1
    PUNCTURE = 2
    REENTRY = 3
    EXIT = 4
    LAYER = 5
    OBSTACLE = 6
    FLASHBACK = 7
    LOSS_OF_RESISTANCE = 8
