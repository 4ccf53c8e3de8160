"""Fast access to a few fields of encoded messages: LCM's wire format, big-endian.

The messages of any type, slower: nao log json.
"""

import struct

# All begin with the fingerprint, then utime; those of the control loop go on with the tick.
_UTIME = struct.Struct(">8xq")
_TICK = struct.Struct(">16xq")
_INT32 = struct.Struct(">i")

# In the order of motion_state_t.MODE_*.
MODES = ("relaxed", "holding", "moving", "walking", "acting", "falling", "fallen", "getting-up", "no-robot")


def read_utime(message):
    """Robot time, microseconds."""
    return _UTIME.unpack_from(message)[0]


def read_tick(message):
    """Control tick of a sensor_state_t, joint_command_t or robot_state_t."""
    return _TICK.unpack_from(message)[0]


def read_mode(message):
    """Mode of a motion_state_t."""
    return MODES[message[16]]


def read_walk(message):
    """Commanded velocity of a walk_command_t: m/s ahead, m/s to the left, rad/s."""
    size = _INT32.unpack_from(message, 24)[0]
    return struct.unpack_from(">3d", message, 28 + size + 8)
