#!/usr/bin/python3
"""The robot walks to the ball that it sees. Needs OpenCV (Debian: python3-opencv).

follow_ball.py [ADDRESS] [SECONDS]
Exit status: 0 the ball was reached, 1 it was not, 77 OpenCV is missing.
"""

import math
import sys
import time

import nao_remote

try:
    import cv2
except ImportError:
    sys.stderr.write("OpenCV is missing (Debian: python3-opencv)\n")
    sys.exit(77)

# Hue (0 to 180), saturation and value of the carpet: green.
CARPET = ((35, 60, 40), (90, 255, 255))
# Area of an outline relative to that of the circle around it. Chosen: between a ball (0.9) and a line or post (0.5).
LEAST_ROUNDNESS = 0.7
# Radius of the ball in an image of 320 pixels when the robot stops: about 0.7 m from the camera, 0.6 m from the feet. Nearer, it
# leaves the image.
NEAR_RADIUS = 20


def find_ball(image):
    """@return (x, y, radius) of the largest round thing that is not carpet, in pixels; None if there is none."""
    hsv = cv2.cvtColor(image, cv2.COLOR_BGR2HSV)
    outlines, _ = cv2.findContours(cv2.bitwise_not(cv2.inRange(hsv, *CARPET)), cv2.RETR_LIST, cv2.CHAIN_APPROX_SIMPLE)
    found = []
    for outline in outlines:
        (x, y), radius = cv2.minEnclosingCircle(outline)
        if radius > 3 and cv2.contourArea(outline) > LEAST_ROUNDNESS * math.pi * radius ** 2:
            found.append((radius, x, y))
    if not found:
        return None
    radius, x, y = max(found)
    return x, y, radius


def follow(robot, seconds):
    """@return whether the ball was reached in time."""
    deadline = time.monotonic() + seconds
    with robot.images(rate=10, width=320) as images:
        for image in images:
            ball = find_ball(image.to_array())
            if time.monotonic() > deadline:
                return False
            if ball is None:
                robot.walk(0, 0, 0.3)  # look for it
                continue
            x, _, radius = ball
            if radius >= NEAR_RADIUS:
                robot.walk()
                print(f"the ball is near: {radius:.0f} pixels")
                return True
            # Positive: to the left of the image's middle.
            direction = (image.width / 2 - x) / (image.width / 2)
            robot.walk(0.12 * max(0.0, 1 - 2 * abs(direction)), 0, 0.6 * direction)


with nao_remote.connect(*sys.argv[1:2]) as robot:
    robot.posture(robot.description.ready_posture)
    robot.change_joints(robot.description.camera_group, pitch=0.25)
    reached = follow(robot, float(sys.argv[2]) if len(sys.argv) > 2 else 60)
sys.exit(0 if reached else 1)
