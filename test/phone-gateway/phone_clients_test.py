#!/usr/bin/python3
"""Raw TCP clients in two languages move a simulated robot and receive its state."""

import socket
import tempfile
import unittest
from pathlib import Path

from programs import DEADLINE, Robot, wait_until

import phone
from nao_remote import remote_pb2 as pb

# data/robots/nao/postures.yaml: the torso of a crouching NAO is 0.229 m above the floor.
CROUCH_HEIGHT = 0.229
TOLERANCE = 0.015


class PhoneClients(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = cls.enterClassContext(Robot())

    def setUp(self):
        self.robot.stand()

    def phone(self, **options):
        return phone.Phone(port=self.robot.gateway.tcp_port, timeout=DEADLINE, **options)

    def go_to(self, client, posture):
        request_id = client.ask(go_to_posture=pb.GoToPosture(posture=posture)).request_id
        result = client.wait_for_result(request_id, DEADLINE)
        self.assertIsNotNone(result, posture)
        self.assertEqual(result.status, pb.Notice.DONE, result.message)

    def test_the_command_line_phone_sends_the_robot_to_a_crouch(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "view.jpg"

            def image_in(posture):
                result = self.robot.nao_phone("posture", posture)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                return take_image()

            def take_image():
                self.assertEqual(self.robot.nao_phone("image", file).returncode, 0)
                return file.read_bytes()

            standing = image_in("Stand")
            self.assertEqual(standing[:2], b"\xff\xd8", "a JPEG")
            crouching = image_in("Crouch")
            self.assertAlmostEqual(self.robot.torso_height(), CROUCH_HEIGHT, delta=TOLERANCE)
            # The newest image may be from before the crouch.
            wait_until(lambda: crouching != standing or take_image() != standing, "the camera sank with the head")

    def test_the_command_line_phone_saves_an_image_of_the_camera_that_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            images = [Path(folder) / f"{name}.jpg" for name in ("top", "bottom")]
            for image in images:
                result = self.robot.nao_phone("image", image, "--camera", image.stem)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            # The lower camera of a standing robot sees the floor before its feet, not the room.
            self.assertNotEqual(*[image.read_bytes() for image in images])
            wrong = self.robot.nao_phone("image", images[0], "--camera", "behind")
            self.assertNotEqual(wrong.returncode, 0)
            self.assertIn("behind", wrong.stdout + wrong.stderr)

    def test_the_python_client_receives_the_true_state(self):
        with self.phone(name="Ana") as client:
            client.ask(subscribe=pb.Subscribe(state_rate=20, image_rate=10))
            client.ask(take_control=pb.TakeControl())
            self.go_to(client, "Stand")
            self.assertTrue(client.wait_until(lambda: client.image, DEADLINE))
            standing = client.image.jpeg
            self.go_to(client, "Crouch")
            crouched = client.state.utime
            client.wait_until(lambda: client.state.posture == "Crouch" and client.image.utime > crouched, DEADLINE)
            truth = self.robot.truth()
            seen = client.joint_positions()
            height = client.state.torso_position[2]
            self.assertNotEqual(client.image.jpeg, standing)
        self.assertAlmostEqual(truth["position_torso_in_world"][2], CROUCH_HEIGHT, delta=TOLERANCE)
        self.assertAlmostEqual(height, CROUCH_HEIGHT, delta=TOLERANCE)
        for name, angle in zip(truth["joint_names"], truth["joint_position"]):
            self.assertAlmostEqual(seen[name], angle, delta=0.03, msg=name)

    def test_a_spectator_receives_the_state_of_a_turning_joint(self):
        with self.phone(name="Ana") as driver, self.phone(name="Ben") as spectator:
            driver.ask(take_control=pb.TakeControl())
            self.go_to(driver, "Stand")
            spectator.ask(subscribe=pb.Subscribe(state_rate=20))
            with self.assertRaises(phone.Refused) as refused:
                spectator.ask(change_joints=pb.ChangeJoints(group="head", yaw=0.3))
            self.assertEqual(refused.exception.code, pb.CONTROL_TAKEN)
            self.assertEqual(refused.exception.response.control.driver_name, "Ana")
            driver.ask(change_joints=pb.ChangeJoints(group="head", yaw=0.3))
            self.assertTrue(spectator.wait_until(
                lambda: spectator.state and abs(spectator.joint_positions()["HeadYaw"] - 0.3) < 0.03, DEADLINE))

    def test_a_client_can_poll_the_state(self):
        """Every 0.1 s the joints and the newest image in one answer."""
        with self.phone(name="Ana") as client:
            yaw = [joint.name for joint in client.robot.joints].index("HeadYaw")
            client.ask(take_control=pb.TakeControl())
            client.ask(change_joints=pb.ChangeJoints(group="head", yaw=0.5, speed=0.1))
            states, images = [], []

            def poll():
                answer = client.ask(get_state=pb.GetState(with_image=True)).state_and_image
                states.append(answer.state)
                if answer.HasField("image"):
                    images.append(answer.image)
                client.wait_until(lambda: False, 0.1)
                return abs(states[-1].joint_position[yaw] - 0.5) < 0.02 and len(images) > 10
            wait_until(poll, "the head has turned")
        intermediate = {state.joint_position[yaw] for state in states if 0.02 < state.joint_position[yaw] < 0.48}
        self.assertGreater(len(intermediate), 2, "intermediate angles were received")
        times = [state.utime for state in states]
        self.assertEqual(times, sorted(times), "no state is older than the one before")
        times = [image.utime for image in images]
        self.assertEqual(times, sorted(set(times)), "no image is sent twice")

    def test_a_client_chooses_camera_size_and_quality(self):
        def image(client, **request):
            client.ask(subscribe=pb.Subscribe(image_rate=30, image=pb.ImageRequest(**request)))
            last = client.image.utime if client.image else 0
            # The camera still renders the previous request for a moment.
            self.assertTrue(client.wait_until(lambda: client.image and client.image.utime > last + 1500000, DEADLINE))
            self.assertEqual(client.image.camera, request.get("camera", "top"))
            self.assertEqual((client.image.width, client.image.height), (request["width"], request["width"] * 3 // 4))
            return client.image.jpeg

        with self.phone(name="Ana") as client:
            for width in (640, 320, 160):
                fine = image(client, width=width, quality=90)
                coarse = image(client, width=width, quality=20)
                self.assertLess(len(coarse), len(fine) / 2, width)
            image(client, width=320, camera="bottom")

    def test_the_status_on_the_bus_has_the_figures_of_each_client(self):
        with self.phone(name="Ana") as client:
            figure = f"client_{client.connected.client_id}_requests_total"

            def is_reported():
                client.ask(ping=pb.Ping())
                return figure in self.robot.nao("status", "--json")
            wait_until(is_reported, figure)

    def test_invalid_requests_move_nothing(self):
        before = self.robot.truth()
        for garbage in (b"\xff" * 100, b"\0\0\0\x05short", b"GET / HTTP/1.1\r\n\r\n", b"\0\0\0\0" * 50):
            for port in (self.robot.gateway.tcp_port, self.robot.gateway.http_port):
                with socket.create_connection(("127.0.0.1", port)) as connection:
                    connection.sendall(garbage)
        with self.phone(name="Ana") as client:
            client.ask(take_control=pb.TakeControl())
            for bad in ({"go_to_posture": pb.GoToPosture(posture="Handstand")},
                        {"change_joints": pb.ChangeJoints(group="tail", yaw=0.1)},
                        {"change_joints": pb.ChangeJoints(group="head", yaw=float("nan"))},
                        {"walk_turn": pb.WalkTurn(vx=float("inf"))},
                        {"do_action": pb.DoAction(action="juggle")}):
                with self.assertRaises(phone.Refused) as refused:
                    client.ask(**bad)
                self.assertEqual(refused.exception.code, pb.INVALID_ARGUMENT, bad)
        after = self.robot.truth()
        for name, was, is_now in zip(before["joint_names"], before["joint_position"], after["joint_position"]):
            self.assertAlmostEqual(was, is_now, delta=0.01, msg=name)

    def test_a_client_drives_again_after_the_gateway_was_killed(self):
        with self.phone(name="Ana") as client:
            self.robot.gateway.kill()
            with self.assertRaises(phone.ConnectionLost):
                client.wait_until(lambda: False, DEADLINE)
        self.robot.start_gateway()
        self.robot.stand()

    def test_a_killed_motion_program_is_reported_until_it_is_restarted(self):
        def is_reported_as(client, is_available):
            return any(notice.kind == pb.Notice.COMPONENT_CHANGED and
                       notice.component == pb.Notice.MOTION and notice.is_available == is_available for notice in client.notices)
        with self.phone(name="Ana") as client:
            client.ask(take_control=pb.TakeControl())
            self.robot.programs["nao-motion"].kill()
            self.assertTrue(client.wait_until(lambda: is_reported_as(client, False), DEADLINE))
            with self.assertRaises(phone.Refused) as refused:
                client.ask(go_to_posture=pb.GoToPosture(posture="Stand"))
            self.assertEqual(refused.exception.code, pb.ROBOT_UNAVAILABLE)
            self.robot.start("nao-motion")
            self.assertTrue(client.wait_until(lambda: is_reported_as(client, True), DEADLINE))


if __name__ == "__main__":
    unittest.main()
