#!/usr/bin/python3
"""The robot greets in five languages, with an eye color for each.

greet.py [ADDRESS]    such as http://nao.local:8080/#token=k7; without: this host
"""

import sys

import nao_remote

GREETINGS = {"en": ("Hello!", "#ff0000"), "de": ("Guten Tag!", "#ffa500"), "fr": ("Bonjour !", "#00ff00"),
             "es": ("¡Buenos días!", "#00ffff"), "it": ("Buongiorno!", "#ff00ff")}

with nao_remote.connect(*sys.argv[1:2]) as robot:
    eyes = [name for name in robot.lights if name.endswith("eye")]
    for language, (text, color) in GREETINGS.items():
        # Beneath the speaker's own light, which ends with the speech.
        robot.set_lights({eye: color for eye in eyes})
        robot.say(text, language=language)
    robot.set_lights({eye: "#000000" for eye in eyes})
