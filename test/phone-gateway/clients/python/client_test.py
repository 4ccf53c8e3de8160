#!/usr/bin/python3
"""The package nao_remote against a fake gateway."""

import asyncio
import gc
import inspect
import os
import select
import signal
import subprocess
import sys
import tempfile
import threading
import time
import tracemalloc
import unittest
import warnings
from pathlib import Path
from unittest import mock

import built_package  # noqa: F401
import nao_remote
from fake_gateway import FakeGateway, description, refuse, result, state
from nao_remote import aio, connection, session, walking
from nao_remote import remote_pb2 as pb
from programs import DEADLINE, wait_until

# This client has no second connection, which would join the first; visitors of an exhibition and its operator have pages.
USE_CASES = ({field.name for field in pb.Request.DESCRIPTOR.oneofs_by_name["use_case"].fields}
             - {"join", "attend", "run_exhibition"})


class WithGateway(unittest.TestCase):
    def setUp(self):
        self.gateway = self.enterContext(FakeGateway())
        # As fast as a test wants it.
        self.enterContext(mock.patch.object(connection, "FIRST_DELAY", 0.02))
        self.enterContext(mock.patch.object(connection, "LONGEST_DELAY", 0.1))

    def connect(self, address=None, **options):
        return self.enterContext(nao_remote.connect(address or self.gateway.address, **{"timeout": DEADLINE, **options}))


# Walks under the locale of the environment, whose numbers must have a decimal comma.
COMMA = """
import locale, sys
locale.setlocale(locale.LC_ALL, "")
assert locale.str(1.5) == "1,5", locale.str(1.5)
import built_package, nao_remote
with nao_remote.connect(sys.argv[1], timeout=30) as robot:
    robot.walk(0.25, 0.5, -0.125, duration=0.2)
    print(f"{robot.state().age_ms:.1f}")
"""


class Locales(WithGateway):
    def test_a_decimal_comma_changes_nothing(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        try:
            subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", f"{folder}/de_DE.UTF-8"], check=True, capture_output=True)
        except (OSError, subprocess.CalledProcessError) as error:
            self.skipTest(f"no localedef ({error}): install locales")
        told = subprocess.run([sys.executable, "-c", COMMA, self.gateway.address], capture_output=True, text=True, check=False,
                              cwd=Path(__file__).parent, env={**os.environ, "LOCPATH": folder, "LC_ALL": "de_DE.UTF-8"})
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual(self.gateway.received("walk_turn")[0], pb.WalkTurn(vx=0.25, vy=0.5, wz=-0.125))
        self.assertRegex(told.stdout, r"^[0-9]+\.[0-9]\n$")


class SeveralRobots(WithGateway):
    """A gateway with the robots NAO and NAO2."""

    def setUp(self):
        super().setUp()
        self.robots = pb.RobotList()
        self.robots.robots.add(name="NAO", model="nao", is_available=True)
        self.robots.robots.add(name="NAO2", model="t1", team=1, number=4, driver_id=9, driver_name="Ana")
        self.watched = "NAO"
        self.gateway.answers["connect"] = self.answer_connect
        self.gateway.answers["watch_robot"] = lambda request: self.answer_change(request, request.watch_robot.robot, False)
        self.gateway.answers["take_control"] = lambda request: self.answer_change(request, request.take_control.robot, True)

    def answer_connect(self, request):
        name = request.connect.robot or "NAO"
        connected = pb.Connected(protocol_version=1, client_id=3, robot=self.describe(name), robots=self.robots)
        return [pb.ServerMessage(response=pb.Response(request_id=request.request_id, connected=connected))]

    def answer_change(self, request, name, is_mine):
        if name not in ("", "NAO", "NAO2"):
            return [refuse(request, pb.INVALID_ARGUMENT, "There is no such robot.", "robot-unknown")]
        control = pb.Control(driver_id=3 if is_mine else 0, is_mine=is_mine)
        messages = [pb.ServerMessage(response=pb.Response(request_id=request.request_id, control=control))]
        if name not in ("", self.watched):
            self.watched = name
            messages.append(pb.ServerMessage(notice=pb.Notice(kind=pb.Notice.ROBOT_CHANGED, robot=self.describe(name))))
        return messages

    @staticmethod
    def describe(name):
        robot = description()
        robot.name = name
        return robot

    def test_are_listed_with_team_and_driver(self):
        robot = self.connect()
        self.assertEqual([entry.name for entry in robot.robots], ["NAO", "NAO2"])
        self.assertEqual((robot.robots[1].team, robot.robots[1].number, robot.robots[1].driver_name), (1, 4, "Ana"))
        self.assertIsNone(robot.robots[0].team)
        self.robots.robots[1].driver_id = 0
        with robot.events(DEADLINE) as events:
            self.gateway.send(notice=pb.Notice(kind=pb.Notice.ROBOTS_CHANGED, robots=self.robots))
            self.assertEqual(next(events).robots[1].driver_id, 0)
        self.assertEqual(robot.robots[1].driver_id, 0)

    def test_one_is_chosen_at_the_connection_and_again_after_its_loss(self):
        robot = self.connect(robot="NAO2")
        self.assertEqual(robot.description.name, "NAO2")
        self.gateway.drop()
        wait_until(lambda: [request.robot for request in self.gateway.received("connect")] == ["NAO2", "NAO2"],
                   "a connection to the same robot")

    def test_another_one_is_watched_and_driven(self):
        robot = self.connect()
        self.assertEqual(robot.watch("NAO2").name, "NAO2")
        self.assertTrue(robot.take_control("NAO").is_mine)
        self.assertEqual(robot.description.name, "NAO")
        self.assertTrue(robot.control.is_mine)
        with self.assertRaises(nao_remote.InvalidArgument):
            robot.watch("NAO9")

    def test_a_command_to_the_robot_before_is_interrupted(self):
        self.gateway.answers["move_to"] = lambda request: [
            pb.ServerMessage(response=pb.Response(request_id=request.request_id)), result(request.request_id, pb.Notice.ACCEPTED)]
        robot = self.connect()
        moving = robot.move_to(1, 0, 0, wait=False)
        robot.watch("NAO2")
        with self.assertRaises(nao_remote.CommandInterrupted):
            moving.wait(DEADLINE)


class Requests(WithGateway):
    def test_every_request_of_the_protocol_is_reachable(self):
        robot = self.connect()
        robot.take_control()
        robot.state()
        robot.image()
        robot.walk(0.1, 0, 0, duration=0.01)
        robot.move_to(1, 0, 0)
        robot.posture("Sit")
        robot.joints["HeadYaw"].move_by(0.3)
        robot.action("wave")
        robot.play("score")
        robot.say("hello")
        robot.lights["chest"].set("#ff0000")
        robot.motions()
        robot.motion("bow")
        robot.check_motion(pb.Motion(name="bow"))
        robot.save_motion(pb.Motion(name="bow"))
        robot.delete_motion("bow")
        robot.request(drag=pb.Drag(link="LWrist"))
        robot.stop()
        robot.release_control()
        robot.ping()
        robot.operator.clients()
        robot.request(watch_robot=pb.WatchRobot(robot="NAO"))
        with robot.states() as states:
            wait_until(lambda: self.gateway.received("subscribe"), "the subscription")
            self.gateway.send(state=state())
            next(states)
        self.assertEqual({request.WhichOneof("use_case") for request in self.gateway.requests}, USE_CASES)

    def test_arguments_arrive_as_given(self):
        robot = self.connect(name="Ana")
        robot.walk(0.1, 0.2, 0.3)
        robot.move_to(1, 2, 3)
        robot.posture("Sit", 0.7)
        robot.change_joints("head", yaw=0.1, pitch=0.2, speed=0.4, allow_tipping=True, both_sides=True)
        robot.action("kick-left", ball=(0.2, 0.1), strength=0.5)
        robot.action("wave")
        robot.image("bottom", 640, 90)
        robot.operator.kick(7)
        self.assertEqual(self.gateway.received("connect")[0].client_name, "Ana")
        self.assertEqual(self.gateway.received("walk_turn")[0], pb.WalkTurn(vx=0.1, vy=0.2, wz=0.3))
        self.assertEqual(self.gateway.received("move_to"), [pb.MoveTo(x=1, y=2, theta=3)])
        self.assertEqual(self.gateway.received("go_to_posture"), [pb.GoToPosture(posture="Sit", speed=0.7)])
        self.assertEqual(self.gateway.received("change_joints"), [pb.ChangeJoints(
            group="head", yaw=0.1, pitch=0.2, speed=0.4, allow_tipping=True, both_sides=True)])
        self.assertEqual(self.gateway.received("do_action"), [
            pb.DoAction(action="kick-left", ball_x=0.2, ball_y=0.1, strength=0.5), pb.DoAction(action="wave")])
        self.assertEqual(self.gateway.received("get_state")[0].image, pb.ImageRequest(camera="bottom", width=640, quality=90))
        self.assertEqual(self.gateway.received("operate"), [pb.Operate(operation=pb.Operate.KICK, client_id=7)])

    def test_taught_motions_are_saved_read_and_deleted(self):
        robot = self.connect()
        self.gateway.answers["list_motions"] = lambda request: [pb.ServerMessage(response=pb.Response(
            request_id=request.request_id, motions=pb.MotionList(names=["bow"])))]
        self.gateway.answers["get_motion"] = lambda request: [pb.ServerMessage(response=pb.Response(
            request_id=request.request_id, motion_file=pb.MotionFile(yaml="actions: ...")))]
        self.assertEqual(robot.motions(), ["bow"])
        self.assertEqual(robot.motion("bow"), "actions: ...")
        robot.save_motion("actions: ...", replace=True)
        robot.check_motion(pb.Motion(name="bow"))
        robot.delete_motion("bow")
        self.assertEqual(self.gateway.received("save_motion"), [pb.SaveMotion(
            motion=pb.MotionFile(yaml="actions: ..."), replace=True)])
        self.assertEqual(self.gateway.received("check_motion")[0].motion.motion.name, "bow")
        self.assertEqual(self.gateway.received("delete_motion"), [pb.DeleteMotion(name="bow")])
        self.assertEqual(len(self.gateway.received("take_control")), 1)

    def test_a_motion_that_is_not_safe_says_where_and_offers_a_repair(self):
        robot = self.connect()
        report = pb.MotionReport(keyframe=2, repair="slowed-down", repaired=pb.Motion(name="bow"))
        self.gateway.answers["check_motion"] = lambda request: [
            refuse(request, pb.INVALID_ARGUMENT, "The robot would fall.", "motion-fall", motion_report=report)]
        with self.assertRaises(nao_remote.MotionNotSafe) as unsafe:
            robot.check_motion("actions: ...")
        self.assertEqual((unsafe.exception.keyframe, unsafe.exception.repair), (2, "slowed-down"))
        self.assertEqual(unsafe.exception.repaired.name, "bow")
        self.assertEqual(unsafe.exception.reason_code, "motion-fall")

    def test_the_operator_takes_and_releases_control(self):
        robot = self.connect()
        robot.operator.take_control()
        robot.operator.release_control()
        self.assertEqual([request.operation for request in self.gateway.received("operate")],
                         [pb.Operate.TAKE, pb.Operate.RELEASE])
        self.assertEqual(robot.operator.clients()[0].name, "Python")

    def test_tcp_is_the_other_transport(self):
        robot = self.connect(self.gateway.tcp_address)
        robot.posture("Sit")
        self.assertEqual(robot.ping().robot_utime, 5)

    def test_no_proxy_of_the_web_is_asked(self):
        # Nothing listens on port 9.
        with mock.patch.dict(os.environ, http_proxy="http://127.0.0.1:9", no_proxy=""):
            self.assertEqual(self.connect().ping().robot_utime, 5)

    def test_the_description_is_that_of_the_robot(self):
        robot = self.connect()
        self.assertEqual(list(robot.joints), ["HeadYaw", "HeadPitch", "Tail"])
        self.assertEqual(robot.description.joints["HeadYaw"].max_velocity, 8)
        self.assertEqual(robot.description.actions["kick-left"].side, "left")
        self.assertEqual(robot.description.labels["posture", "Sit", "de"], "Sitzen")
        self.assertEqual(robot.client_id, 3)

    def test_states_are_objects_with_names(self):
        seen = self.connect().state()
        self.assertEqual(seen.joint_position, {"HeadYaw": 0.5, "HeadPitch": -0.25, "Tail": 0.0})
        self.assertIs(seen.mode, nao_remote.Mode.HOLDING)
        self.assertIsNone(seen.activity)

    def test_an_image_is_saved(self):
        with tempfile.TemporaryDirectory() as folder:
            self.connect().image().save(Path(folder) / "view.jpg")
            self.assertEqual((Path(folder) / "view.jpg").read_bytes(), b"JPEG")

    def test_the_blocking_face_has_every_method_of_the_asyncio_face(self):
        from nao_remote import blocking, joints, lights, operator
        for asynchronous, face in ((aio.Robot, blocking.Robot), (joints.Joint, blocking.Joint), (lights.Light, blocking.Light),
                                   (operator.Operator, blocking.Operator)):
            for name, member in inspect.getmembers(asynchronous, inspect.isfunction):
                if name.startswith("_"):
                    continue
                wanted, own = ([(parameter.name, parameter.default, parameter.kind)
                                for parameter in inspect.signature(function).parameters.values()]
                               for function in (member, getattr(face, name)))
                self.assertEqual(wanted, own, name)

    def test_everything_public_is_documented(self):
        for name in nao_remote.__all__:
            member = getattr(nao_remote, name)
            self.assertTrue(inspect.getdoc(member) or name == "Event", name)
            if inspect.isclass(member):
                for method_name, method in inspect.getmembers(member, inspect.isfunction):
                    if not method_name.startswith("_") and method.__module__.startswith("nao_remote"):
                        self.assertTrue(inspect.getdoc(method) or method_name == "from_protocol", f"{name}.{method_name}")


class SpeechAndLights(WithGateway):
    def test_a_text_is_spoken_with_its_language_volume_and_rate(self):
        robot = self.connect()
        robot.say("Guten Tag", language="de", volume=0.5, rate=1.5)
        said = self.gateway.received("say")[-1]
        self.assertEqual((said.operation, said.text, said.language, said.volume, said.rate),
                         (pb.Say.SAY, "Guten Tag", "de", 0.5, 1.5))
        robot.say("and then", after=True)
        self.assertEqual(self.gateway.received("say")[-1].operation, pb.Say.SAY_AFTER)
        robot.stop_speaking()
        self.assertEqual(self.gateway.received("say")[-1].operation, pb.Say.STOP)
        self.assertEqual(robot.description.languages, ("en", "de"))

    def test_silence_is_a_volume(self):
        self.connect().say("hello", volume=0)
        self.assertTrue(self.gateway.received("say")[-1].HasField("volume"))

    def test_lights_are_set_and_read_by_name(self):
        robot = self.connect()
        self.assertEqual(list(robot.lights), ["left-eye", "chest"])
        self.assertEqual(robot.lights["left-eye"].color(), (1, 0, 0.2))
        robot.lights["chest"].set("#ff8000", 2)
        sent = self.gateway.received("set_lights")[-1]
        self.assertEqual((list(sent.light_names), list(sent.light_rgb), sent.duration), (["chest"], [0xff8000], 2))
        robot.set_lights({"left-eye": (0, 1, 0.2), "chest": (0, 0, 0)})
        self.assertEqual(list(self.gateway.received("set_lights")[-1].light_rgb), [0x00ff33, 0])
        with self.assertRaises(KeyError):
            robot.lights["tail"].set("#ff8000")

    def test_states_have_the_condition_of_the_body(self):
        body = self.connect().state().body
        self.assertEqual((body.battery_charge, body.is_charging, body.warnings), (0.5, False, ("battery-low",)))
        self.assertEqual((body.hottest_joint, body.hottest_temperature, body.faulty_joints), ("HeadYaw", 40, ()))

    def test_what_is_no_color_is_refused(self):
        robot = self.connect()
        for color in ("red", "#12345", "#12345g", "", (1, 1), (0, 0, 2), (0, 0, float("nan"))):
            with self.subTest(color=color), self.assertRaises(ValueError):
                robot.lights["chest"].set(color)

    def test_a_walk_goes_on_while_it_speaks(self):
        robot = self.connect()
        robot.walk(0.1)
        robot.say("hello")
        robot.lights["chest"].set("#ff8000")
        before = len(self.gateway.received("walk_turn"))
        wait_until(lambda: len(self.gateway.received("walk_turn")) > before, "the walk goes on")
        robot.walk()


class Joints(WithGateway):
    def test_a_joint_is_moved_by_its_group_and_axis(self):
        robot = self.connect()
        robot.joints["HeadPitch"].move_by(0.3, 0.5)
        self.assertEqual(self.gateway.received("change_joints"), [pb.ChangeJoints(group="head", pitch=0.3, speed=0.5)])

    def test_a_joint_is_moved_to_an_angle_within_its_limits(self):
        robot = self.connect()
        robot.joints["HeadYaw"].move_to(3)
        robot.joints["HeadYaw"].move_to(0.5)
        by = [request.yaw for request in self.gateway.received("change_joints")]
        self.assertEqual(by[0], 2 - 0.5)
        # A change of 0 would be refused.
        self.assertTrue(0 < by[1] < 1e-5)

    def test_joints_that_do_not_exist_or_cannot_be_moved_are_named(self):
        robot = self.connect()
        with self.assertRaisesRegex(KeyError, "Wing.*it has HeadYaw"):
            robot.joints["Wing"]
        with self.assertRaisesRegex(nao_remote.InvalidArgument, "Tail"):
            robot.joints["Tail"].move_by(0.1)


class Errors(WithGateway):
    def test_every_error_of_the_protocol_has_its_exception(self):
        robot = self.connect()
        for code in pb.ErrorCode.values():
            if code == pb.OK:
                continue
            self.gateway.answers["stop"] = lambda request, code=code: [
                refuse(request, code, "The sentence.", "the-code", ["1", "two"])]
            with self.assertRaises(nao_remote.Refused) as refused:
                robot.stop()
            self.assertEqual(str(refused.exception), "The sentence.")
            self.assertEqual((refused.exception.reason_code, refused.exception.reason_arguments), ("the-code", ("1", "two")))
            self.assertEqual(refused.exception.error_code, code)
            self.assertIsNot(type(refused.exception), nao_remote.Refused, pb.ErrorCode.Name(code))

    def test_control_taken_names_the_driver(self):
        self.gateway.answers["take_control"] = lambda request: [refuse(
            request, pb.CONTROL_TAKEN, "Ana has control.", "control-taken", ["Ana"], control=pb.Control(driver_id=1, driver_name="Ana"))]
        with self.assertRaises(nao_remote.ControlTaken) as refused:
            self.connect().posture("Sit")
        self.assertEqual(refused.exception.driver_name, "Ana")
        self.assertFalse(self.gateway.received("go_to_posture"))

    def test_ends_of_commands_have_their_exceptions(self):
        robot = self.connect()
        for status, kind in ((pb.Notice.REFUSED, nao_remote.CommandRefused), (pb.Notice.FAILED, nao_remote.CommandFailed),
                             (pb.Notice.INTERRUPTED, nao_remote.CommandInterrupted)):
            self.gateway.answers["go_to_posture"] = lambda request, status=status: [
                pb.ServerMessage(response=pb.Response(request_id=request.request_id)),
                result(request.request_id, status, "The robot fell.", "robot-fell")]
            with self.assertRaises(nao_remote.CommandFailed) as failed:
                robot.posture("Sit")
            self.assertIs(type(failed.exception), kind)
            self.assertEqual((str(failed.exception), failed.exception.reason_code), ("The robot fell.", "robot-fell"))

    def test_silence_is_a_timeout(self):
        robot = self.connect(timeout=0.2)
        self.gateway.answers["stop"] = lambda request: []
        with self.assertRaises(nao_remote.Timeout):
            robot.stop()
        self.gateway.answers["go_to_posture"] = lambda request: [
            pb.ServerMessage(response=pb.Response(request_id=request.request_id))]
        with self.assertRaises(nao_remote.Timeout):
            robot.posture("Sit", timeout=0.1)
        with robot.states(timeout=0.1) as states, self.assertRaises(TimeoutError):
            next(states)

    def test_a_wrong_token_is_refused_at_once(self):
        with self.assertRaises(nao_remote.WrongToken):
            nao_remote.connect(f"127.0.0.1:{self.gateway.port}", token="guess")
        self.assertEqual(self.gateway.num_connections, 1)

    def test_no_gateway_is_a_lost_connection_that_says_where(self):
        with FakeGateway() as other:
            addresses = (other.address, other.tcp_address)
        for address in addresses:
            with self.assertRaisesRegex(nao_remote.ConnectionLost, "127.0.0.1") as lost:
                nao_remote.connect(address)
            self.assertNotIn("k7", str(lost.exception))

    def test_other_services_are_no_gateways(self):
        # protobuf warns about bytes that are not a message.
        self.enterContext(warnings.catch_warnings())
        warnings.simplefilter("ignore", RuntimeWarning)
        for reply in (b"HTTP/1.1 400 Bad Request\r\n\r\n", b"\xff\xff\xff\xff", b"\0\0\0\5hello", b""):
            server = self.enterContext(self.service(reply))
            for scheme in ("ws", "tcp"):
                with self.assertRaises(nao_remote.ConnectionLost):
                    nao_remote.connect(f"{scheme}://127.0.0.1:{server.port}", timeout=2)

    def service(self, reply):
        class Service:
            def __enter__(self):
                import socketserver

                class Handler(socketserver.BaseRequestHandler):
                    def handle(self):
                        self.request.recv(100)
                        self.request.sendall(reply)
                self.server = socketserver.ThreadingTCPServer(("127.0.0.1", 0), Handler)
                self.port = self.server.server_address[1]
                threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.01}).start()
                return self

            def __exit__(self, *_):
                self.server.shutdown()
                self.server.server_close()
        return Service()


class Control(WithGateway):
    def test_the_first_motion_takes_control(self):
        robot = self.connect()
        self.assertFalse(robot.control.is_mine)
        robot.posture("Sit")
        robot.posture("Stand")
        self.assertEqual(len(self.gateway.received("take_control")), 1)
        self.assertTrue(robot.control.is_mine)

    def test_control_is_not_taken_by_itself_without_leave(self):
        robot = self.connect(auto_control=False)
        robot.posture("Sit")
        self.assertFalse(self.gateway.received("take_control"))

    def test_control_that_another_client_took_is_not_taken_back_by_itself(self):
        robot = self.connect()
        robot.posture("Sit")
        with robot.events(timeout=DEADLINE) as events:
            self.gateway.send(notice=pb.Notice(kind=pb.Notice.CONTROL_CHANGED, message="Ben has control now.",
                                               control=pb.Control(driver_id=9, driver_name="Ben")))
            event = next(event for event in events if isinstance(event, nao_remote.ControlChanged))
        self.assertEqual(event.control.driver_name, "Ben")
        robot.posture("Sit")
        self.assertEqual(len(self.gateway.received("take_control")), 1)
        robot.take_control()
        self.assertTrue(robot.control.is_mine)

    def test_a_block_has_control(self):
        robot = self.connect()
        with robot.driving():
            self.assertTrue(robot.control.is_mine)
        self.assertFalse(robot.control.is_mine)


class Walking(WithGateway):
    def test_a_walk_is_repeated_until_another_motion(self):
        robot = self.connect()
        walk = robot.walk(0.2, 0, 0)
        wait_until(lambda: len(self.gateway.received("walk_turn")) >= 3, "three walk requests")
        self.assertFalse(walk.is_done)
        robot.walk(0.1, 0, 0)
        robot.posture("Sit")
        count = len(self.gateway.received("walk_turn"))
        self.assertEqual(self.gateway.received("walk_turn")[-1].vx, 0.1)
        robot.ping()
        time.sleep(0.3)
        self.assertEqual(len(self.gateway.received("walk_turn")), count)

    def test_a_walk_whose_robot_nobody_references_ends(self):
        robot = nao_remote.connect(self.gateway.address)
        states = robot.states()
        self.addCleanup(states.close)
        robot.walk(0.2)
        del robot
        wait_until(lambda: self.gateway.received("walk_turn")[-1] == pb.WalkTurn(), "the end of the walk")

    def test_joints_move_during_a_walk(self):
        robot = self.connect()
        robot.walk(0.2, 0, 0)
        robot.joints["HeadYaw"].move_by(0.1)
        count = len(self.gateway.received("walk_turn"))
        wait_until(lambda: len(self.gateway.received("walk_turn")) > count, "the walk goes on")

    def test_a_walk_of_a_duration_returns_when_the_robot_stands(self):
        walk = self.connect().walk(0.2, 0, 0, duration=0.25)
        self.assertTrue(walk.is_done)
        self.assertEqual(self.gateway.received("walk_turn")[-1], pb.WalkTurn())

    def test_zero_ends_a_walk(self):
        robot = self.connect()
        walk = robot.walk(0.2, 0, 0)
        self.assertEqual(robot.walk().request_id, walk.request_id)
        walk.wait(DEADLINE)
        self.assertTrue(robot.walk().is_done)

    def test_a_walk_that_the_robot_ended_does_not_begin_again(self):
        robot = self.connect()
        walk = robot.walk(0.2, 0, 0)
        self.gateway.send(notice=result(walk.request_id, pb.Notice.FAILED, "The robot fell.", "robot-fell").notice)
        with self.assertRaisesRegex(nao_remote.CommandFailed, "fell"):
            walk.wait(DEADLINE)
        count = len(self.gateway.received("walk_turn"))
        time.sleep(0.3)
        self.assertLessEqual(len(self.gateway.received("walk_turn")), count + 1)

    def test_a_walk_of_a_duration_that_the_robot_ended_earlier_has_not_been_done(self):
        def answer(request):
            return [pb.ServerMessage(response=pb.Response(request_id=request.request_id)),
                    result(request.request_id, pb.Notice.ACCEPTED), result(request.request_id, pb.Notice.DONE)]
        robot = self.connect()
        self.gateway.answers["walk_turn"] = answer
        with self.assertRaisesRegex(nao_remote.CommandInterrupted, "before its time"):
            robot.walk(0.2, duration=DEADLINE)

    def test_a_refused_repetition_ends_the_walk(self):
        robot = self.connect()
        walk = robot.walk(0.2, 0, 0)
        self.gateway.answers["walk_turn"] = lambda request: [refuse(request, pb.STOPPED, "Stopped.", "walk-stopped")]
        with self.assertRaises(nao_remote.Stopped):
            walk.wait(DEADLINE)


class WaysOutOfAMotion(WithGateway):
    """A caller that waits for a motion that walks may be cancelled, interrupted or run out of time: the robot then stands."""

    WAYS_OUT = ("wait_for", "cancel", "cancel twice")

    def assert_ends_with_zero(self):
        wait_until(lambda: self.gateway.received("walk_turn")[-1] == pb.WalkTurn(), "velocity zero")
        # Answered requests later there is still no other one.
        count = len(self.gateway.received("walk_turn"))
        with nao_remote.connect(self.gateway.address) as other:
            for _ in range(5):
                time.sleep(walking.PERIOD)
                other.ping()
        self.assertEqual(len(self.gateway.received("walk_turn")), count)

    async def leave(self, way_out, motion, is_begun):
        if way_out == "wait_for":
            with self.assertRaises(asyncio.TimeoutError):
                await asyncio.wait_for(motion, 0.3)
            return
        task = asyncio.ensure_future(motion)
        while not is_begun():
            await asyncio.sleep(0.01)
        task.cancel()
        if way_out == "cancel twice":
            await asyncio.sleep(0)
            task.cancel()
        with self.assertRaises(asyncio.CancelledError):
            await task

    def test_every_way_out_of_a_walk_ends_in_zero_velocity(self):
        walks = {"of a duration": lambda robot: robot.walk(0.2, duration=100),
                 "that goes on": lambda robot: self.change(robot)}
        for way_out in self.WAYS_OUT:
            for name, walk in walks.items():
                with self.subTest(way_out=way_out, walk=name):
                    async def drive():
                        async with await aio.connect(self.gateway.address) as robot:
                            self.gateway.requests.clear()
                            await self.leave(way_out, walk(robot), lambda: self.gateway.received("walk_turn"))
                            await robot.ping()
                            await asyncio.to_thread(self.assert_ends_with_zero)
                    asyncio.run(drive())

    @staticmethod
    async def change(robot):
        while True:
            await robot.walk(0.2)
            await robot.walk(0.3)

    def test_every_way_out_of_a_motion_that_walks_by_itself_stops_it(self):
        begun = lambda request: [pb.ServerMessage(response=pb.Response(request_id=request.request_id)),
                                 result(request.request_id, pb.Notice.ACCEPTED)]
        self.gateway.answers.update(move_to=begun, play=begun, go_to_posture=begun)
        for way_out in (*self.WAYS_OUT, "timeout"):
            for use_case, start in (("move_to", lambda robot: robot.move_to(1, timeout=0.2)),
                                    ("play", lambda robot: robot.play("keep-goal", timeout=0.2))):
                with self.subTest(way_out=way_out, use_case=use_case):
                    self.gateway.requests.clear()

                    async def drive():
                        async with await aio.connect(self.gateway.address) as robot:
                            if way_out == "timeout":
                                with self.assertRaises(nao_remote.Timeout):
                                    await start(robot)
                            elif way_out == "wait_for":
                                with self.assertRaises(asyncio.TimeoutError):
                                    await asyncio.wait_for(start(robot), 0.1)
                            else:
                                await self.leave(way_out, start(robot), lambda: self.gateway.received(use_case))
                            await robot.ping()
                    asyncio.run(drive())
                    self.assertTrue(self.gateway.received("stop"))

    def test_a_motion_that_is_given_up_before_its_answer_is_stopped(self):
        self.gateway.answers["move_to"] = lambda request: []

        async def drive():
            async with await aio.connect(self.gateway.address) as robot:
                await self.leave("cancel", robot.move_to(1), lambda: self.gateway.received("move_to"))
                await robot.ping()
        asyncio.run(drive())
        self.assertTrue(self.gateway.received("stop"))

    def test_ctrl_c_during_a_walk_ends_it(self):
        script = f"""
import nao_remote
robot = nao_remote.connect({self.gateway.address!r})
try:
    robot.walk(0.2, duration=100)
except KeyboardInterrupt:
    print("interrupted", flush=True)
input()
"""
        with subprocess.Popen([sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as program:
            try:
                wait_until(lambda: len(self.gateway.received("walk_turn")) >= 2, "the walk")
                program.send_signal(signal.SIGINT)
                self.assertEqual(program.stdout.readline(), b"interrupted\n")
                self.assert_ends_with_zero()
            finally:
                program.kill()


class OtherProcesses(WithGateway):
    def test_a_robot_used_after_a_fork_says_so(self):
        robot = self.connect()
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            try:
                robot.posture("Sit")
            except nao_remote.Closed as error:
                os.write(writer, str(error).encode())
            finally:
                robot.close()
                os._exit(0)
        os.close(writer)
        self.addCleanup(os.close, reader)
        is_readable, _, _ = select.select([reader], [], [], DEADLINE)
        if not is_readable:
            os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        self.assertTrue(is_readable, "the child waits without end")
        self.assertIn(b"fork", os.read(reader, 1000))
        robot.posture("Sit")

    def test_a_robot_used_in_another_event_loop_says_so(self):
        robot = asyncio.run(aio.connect(self.gateway.address))
        with self.assertRaisesRegex(RuntimeError, "event loop"):
            asyncio.run(robot.stop())


class Streams(WithGateway):
    def test_a_slow_reader_gets_the_newest_state(self):
        robot = self.connect()
        with robot.states(30) as states:
            wait_until(lambda: self.gateway.received("subscribe"), "the subscription")
            for vx in range(1, 101):
                message = state(vx=vx)
                self.gateway.send(state=message)
            robot.ping()
            self.assertEqual(next(states).vx, 100)
            self.assertEqual(states.num_skipped, 99)

    def test_the_subscription_is_what_the_open_streams_need(self):
        robot = self.connect()

        def last():
            return self.gateway.received("subscribe")[-1] if self.gateway.received("subscribe") else None
        slow = robot.states(5)
        wait_until(lambda: last() == pb.Subscribe(state_rate=5), "5 Hz")
        fast = robot.states(20)
        wait_until(lambda: last() == pb.Subscribe(state_rate=20), "20 Hz")
        images = robot.images(10, "bottom", 640)
        wanted = pb.ImageRequest(camera="bottom", width=640)
        wait_until(lambda: last() == pb.Subscribe(state_rate=20, image_rate=10, image=wanted), "images")
        with self.assertRaises(nao_remote.InvalidArgument):
            robot.images(10, "top")
        fast.close()
        wait_until(lambda: last() == pb.Subscribe(state_rate=5, image_rate=10, image=wanted), "5 Hz again")
        # One that is no longer referenced is closed.
        del images
        slow.close()
        wait_until(lambda: last() == pb.Subscribe(), "none")

    def test_images_of_another_subscription_are_dropped(self):
        robot = self.connect()
        with robot.images(10, "top", 160, timeout=DEADLINE) as images:
            wait_until(lambda: self.gateway.received("subscribe"), "the subscription")
            for camera, width in (("top", 320), ("bottom", 160), ("top", 160)):
                self.gateway.send(image=pb.Image(camera=camera, width=width, height=1))
            seen = next(images)
            self.assertEqual((seen.camera, seen.width), ("top", 160))

    def test_a_refused_subscription_is_raised_by_its_stream(self):
        robot = self.connect()
        with robot.states(5, timeout=DEADLINE) as good:
            wait_until(lambda: self.gateway.received("subscribe"), "the subscription")
            robot.ping()
            self.gateway.answers["subscribe"] = lambda request: [
                refuse(request, pb.INVALID_ARGUMENT, "State rate 99 is outside [0, 60] a second.", "state-rate-out-of-range")
                if request.subscribe.state_rate > 60 else pb.ServerMessage(response=pb.Response(request_id=request.request_id))]
            with self.assertRaisesRegex(nao_remote.InvalidArgument, "99"):
                next(robot.states(99, timeout=DEADLINE))
            self.gateway.send(state=state())
            next(good)

    def test_a_closed_stream_ends_its_loop(self):
        robot = self.connect()
        states = robot.states(5)
        states.close()
        self.assertEqual(list(states), [])

    def test_events_are_bounded(self):
        robot = self.connect()
        with robot.events() as events:
            for i in range(300):
                self.gateway.send(notice=result(i, pb.Notice.DONE).notice)
            robot.ping()
            self.assertEqual(next(events).request_id, 300 - 256)

    def test_component_changes_are_events(self):
        with self.connect().events(timeout=DEADLINE) as events:
            self.gateway.send(notice=pb.Notice(kind=pb.Notice.COMPONENT_CHANGED, component=pb.Notice.ROBOT,
                                               message="The robot does not answer.", reason_code="robot-unavailable"))
            event = next(events)
        self.assertEqual((event.component, event.is_available), (nao_remote.Component.ROBOT, False))
        self.assertEqual(event.reason_code, "robot-unavailable")

    def test_a_condition_is_awaited(self):
        robot = self.connect()
        timer = threading.Timer(0.1, lambda: self.gateway.send(state=state(vx=0.5)))
        timer.start()
        self.addCleanup(timer.join)
        self.assertEqual(robot.wait_until(lambda seen: seen.vx == 0.5, DEADLINE).vx, 0.5)
        with self.assertRaises(nao_remote.Timeout):
            robot.wait_until(lambda seen: False, 0.1)


class Reconnection(WithGateway):
    def test_requests_raise_until_the_client_has_connected_again(self):
        robot = self.connect()
        with robot.events(timeout=DEADLINE) as events, robot.states(7, timeout=DEADLINE) as states:
            wait_until(lambda: self.gateway.received("subscribe"), "the subscription")
            walk = robot.walk(0.1, 0, 0)
            self.gateway.stop()
            self.assertIsInstance(next(e for e in events if isinstance(e, nao_remote.Disconnected)), nao_remote.Disconnected)
            with self.assertRaises(nao_remote.ConnectionLost):
                walk.wait(DEADLINE)
            for call in (robot.stop, robot.state, robot.image, robot.ping, lambda: robot.walk(0.1), lambda: robot.posture("Sit"),
                         robot.take_control, robot.operator.clients, robot.joints["HeadYaw"].position):
                with self.assertRaises(nao_remote.ConnectionLost):
                    call()
            self.assertFalse(robot.is_connected)
            self.gateway.requests.clear()
            self.gateway.start()
            robot.wait_until_connected(DEADLINE)
            self.assertIsInstance(next(events), nao_remote.Connected)
            # The stream continues; the walk does not.
            wait_until(lambda: self.gateway.received("subscribe"), "the subscription")
            self.gateway.send(state=state(vx=1))
            self.assertEqual(next(states).vx, 1)
            self.assertFalse(self.gateway.received("walk_turn"))
            robot.posture("Sit")
            self.assertEqual(len(self.gateway.received("take_control")), 1)

    def test_iterators_outlast_an_outage_that_is_longer_than_their_timeout(self):
        with mock.patch.object(session, "PING_PERIOD", 0.05):
            robot = self.connect()
            with robot.states(7, timeout=1) as states:
                wait_until(lambda: self.gateway.received("subscribe"), "the subscription")
                self.gateway.stop()
                self.gateway.requests.clear()
                seen = []
                reading = threading.Thread(target=lambda: seen.append(next(states)))
                reading.start()
                reading.join(1.5)
                self.assertTrue(reading.is_alive(), "the iterator ended during the outage")
                self.gateway.start()
                wait_until(lambda: self.gateway.received("subscribe"), "the subscription")
                self.gateway.send(state=state(vx=1))
                reading.join(DEADLINE)
                self.assertEqual(seen[0].vx, 1)
                with self.assertRaises(nao_remote.Timeout):
                    next(states)

    def test_a_request_without_an_answer_ends_with_the_connection(self):
        robot = self.connect()
        self.gateway.answers["stop"] = lambda request: []
        timer = threading.Timer(0.1, self.gateway.drop)
        timer.start()
        self.addCleanup(timer.join)
        with self.assertRaises(nao_remote.ConnectionLost):
            robot.stop()

    def test_without_reconnection_the_first_loss_is_the_last(self):
        robot = self.connect(reconnect=False)
        with robot.states(timeout=DEADLINE) as states:
            self.gateway.drop()
            with self.assertRaises(nao_remote.Closed):
                next(states)
        with self.assertRaises(nao_remote.Closed):
            robot.stop()
        with self.assertRaises(nao_remote.Closed):
            robot.wait_until_connected(DEADLINE)
        self.assertEqual(self.gateway.num_connections, 1)

    def test_a_token_that_has_changed_ends_the_attempts(self):
        robot = self.connect()
        with robot.events(timeout=DEADLINE) as events:
            self.gateway.token = "other"
            self.gateway.drop()
            last = next(event for event in events if isinstance(event, nao_remote.Disconnected) and event.is_final)
        self.assertEqual(last.reason_code, "token-wrong")
        with self.assertRaises(nao_remote.Closed):
            robot.stop()

    def test_a_silent_gateway_is_a_lost_connection(self):
        with mock.patch.object(session, "SILENCE_TIMEOUT", 0.6), mock.patch.object(session, "PING_PERIOD", 0.1):
            robot = self.connect(reconnect=False)
            time.sleep(1)
            self.assertTrue(robot.is_connected, "pings keep it open")
            self.gateway.answers["ping"] = lambda request: []
            with robot.events(timeout=DEADLINE) as events:
                self.assertRegex(next(events).message, "nothing")

    def test_the_reason_of_a_closing_gateway_is_told(self):
        robot = self.connect(reconnect=False)
        with robot.events(timeout=DEADLINE) as events:
            self.gateway.send(notice=pb.Notice(kind=pb.Notice.CLOSING, message="The gateway stops.", reason_code="gateway-stopping"))
            self.gateway.drop()
            self.assertEqual(next(events).reason_code, "gateway-stopping")

    def test_delays_grow_to_a_bound(self):
        with mock.patch.object(connection, "FIRST_DELAY", 0.5), mock.patch.object(connection, "LONGEST_DELAY", 5.0):
            self.assertEqual([connection.retry_delay(i) for i in (1, 2, 3, 4, 5, 10_000)], [0.5, 1, 2, 4, 5, 5])

    def test_a_closed_client_says_so_and_leaves_no_thread(self):
        before = threading.active_count()
        robot = nao_remote.connect(self.gateway.address)
        events = robot.events()

        def read():
            self.assertTrue(next(events).is_final)
            self.assertRaises(nao_remote.Closed, next, events)
        waiting = threading.Thread(target=read)
        waiting.start()
        robot.close()
        robot.close()
        waiting.join(DEADLINE)
        self.assertFalse(waiting.is_alive())
        self.assertEqual(threading.active_count(), before)
        with self.assertRaises(nao_remote.Closed):
            robot.stop()


class Memory(WithGateway):
    def test_nothing_grows_with_requests_states_and_connections(self):
        robot = self.connect(reconnect=True)
        with robot.states(60, timeout=DEADLINE) as states, robot.events(timeout=DEADLINE) as events:
            def use():
                for _ in range(100):
                    robot.posture("Sit")
                    robot.walk(0.1)
                    robot.walk().wait(DEADLINE)
                    self.gateway.send(state=state())
                    next(states)
                self.gateway.drop()
                next(event for event in events if isinstance(event, nao_remote.Connected))
                self.gateway.requests.clear()
                gc.collect()
                return tracemalloc.get_traced_memory()[0]
            tracemalloc.start()
            self.addCleanup(tracemalloc.stop)
            use()
            before = use()
            after = [use() for _ in range(4)][-1]
        # B. Four times 100 rounds with 4 kB each would be 1.6 MB; caches of the interpreter are allowed.
        self.assertLess(after - before, 100_000)
        self.assertEqual(robot._inner._commands, {})


class Asyncio(WithGateway):
    def test_the_asyncio_face_does_the_same(self):
        async def drive():
            async with await aio.connect(self.gateway.address) as robot:
                await robot.posture("Sit")
                await robot.joints["HeadYaw"].move_by(0.1)
                async with robot.driving():
                    await robot.walk(0.1, 0, 0, duration=0.1)
                both = await asyncio.gather(robot.state(), robot.image())
                with robot.states(timeout=DEADLINE) as states:
                    await robot.ping()
                    self.gateway.send(state=state(vx=0.25))
                    async for seen in states:
                        return both, seen
        both, seen = asyncio.run(drive())
        self.assertEqual(both[0].posture, "Stand")
        self.assertEqual(both[1].jpeg, b"JPEG")
        self.assertEqual(seen.vx, 0.25)

    def test_the_blocking_face_refuses_its_own_loop(self):
        robot = self.connect()
        with self.assertRaisesRegex(RuntimeError, "aio"):
            robot._loop.run(robot.ping)


if __name__ == "__main__":
    unittest.main()
