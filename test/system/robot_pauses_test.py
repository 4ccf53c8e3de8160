#!/usr/bin/python3
"""find_pauses() finds a robot that is silent, waits, or plays no longer, and no other one."""

import json
import unittest

from robot_pauses import AUTO, NO_ROBOT, find_pauses, read


def said(robot, kind, times, **message):
    return [json.dumps({"log_wall_utime": round(time * 1e6), "channel": f"{robot}_{kind}", "message": {"utime": round(time * 1e6), **message}}) for time in times]


def times(begin, end, rate):
    return [begin + i / rate for i in range(int((end - begin) * rate))]


class RobotPauses(unittest.TestCase):
    def setUp(self):
        self.lines = []
        for robot in ("NAO1", "NAO2"):
            self.lines += said(robot, "MOTION_STATE", times(0, 10, 10), mode=3)
            self.lines += said(robot, "PLAY_STATE", times(0, 10, 5), behavior=AUTO, reason_code="", reason="")

    def pauses(self, robot, lines, scale=1):
        rows = sorted((json.loads(line) for line in lines), key=lambda row: row["log_wall_utime"])
        return find_pauses(read(map(json.dumps, rows)), robot, 2, 8, scale)

    def test_robots_that_act_do_not_pause(self):
        self.assertEqual(self.pauses("NAO1", self.lines), [])

    def test_a_silent_program_is_a_pause_of_its_robot_only(self):
        for kind in ("MOTION_STATE", "PLAY_STATE"):
            left = [line for line in self.lines if f"NAO1_{kind}" not in line or not 4e6 < json.loads(line)["log_wall_utime"] < 5.5e6]
            self.assertEqual(len(self.pauses("NAO1", left)), 1, kind)
            self.assertEqual(self.pauses("NAO2", left), [])
            self.assertEqual(self.pauses("NAO1", left, scale=6), [])

    def test_a_late_recorder_is_no_pause(self):
        rows = [json.loads(line) for line in self.lines]
        for row in rows:
            row["log_wall_utime"] = 6e6 if 4e6 < row["log_wall_utime"] < 6e6 else row["log_wall_utime"]
        self.assertEqual(self.pauses("NAO1", [json.dumps(row) for row in rows]), [])

    def test_a_program_that_never_comes_back_is_a_pause(self):
        left = [line for line in self.lines if "NAO1_MOTION" not in line or json.loads(line)["log_wall_utime"] < 4e6]
        self.assertEqual(len(self.pauses("NAO1", left)), 1)

    def test_a_robot_that_says_that_it_does_not_act_pauses(self):
        for added in (said("NAO1", "PLAY_STATE", [5.05], behavior=AUTO, reason_code="vision-unavailable", reason="No images."),
                      said("NAO1", "PLAY_STATE", [5.05], behavior=0, reason_code="", reason=""),
                      said("NAO1", "MOTION_STATE", [5.05], mode=NO_ROBOT)):
            self.assertEqual(len(self.pauses("NAO1", self.lines + added)), 1, added)
            self.assertEqual(self.pauses("NAO2", self.lines + added), [])

    def test_a_fallen_robot_does_not_pause(self):
        added = said("NAO1", "PLAY_STATE", [5.05], behavior=AUTO, reason_code="robot-fallen", reason="It lies.")
        self.assertEqual(self.pauses("NAO1", self.lines + added), [])


if __name__ == "__main__":
    unittest.main()
