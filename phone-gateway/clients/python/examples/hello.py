#!/usr/bin/python3
"""The robot stands up, looks around, waves, walks, and saves what it sees.

hello.py [ADDRESS]    such as http://nao.local:8080/#token=k7; without: this host
"""

import sys

import nao_remote

with nao_remote.connect(*sys.argv[1:2]) as robot:
    robot.posture(robot.description.stand_posture)
    robot.joints["HeadYaw"].move_by(0.3)
    robot.action("wave")
    robot.walk(0.1, duration=3)
    robot.image().save("view.jpg")
    print(f"{robot.description.name}: {robot.state().mode.name}, the view is in view.jpg")
