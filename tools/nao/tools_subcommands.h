#pragma once

namespace nao {

/** A subcommand of nao that the program nao-tools executes: it needs libraries that a start of the
 * robot does not build. */
struct ToolsSubcommand {
  const char* name;
  /** One line of the help text. */
  const char* help;
};

constexpr ToolsSubcommand kSpySubcommand = {
    "spy", "Show every channel on the bus with its type and rate, until Ctrl-C"};

constexpr ToolsSubcommand kCalibrateSubcommand = {
    "calibrate",
    "Learn the errors of this robot's joints and sensors: it moves its weight over its feet in "
    "several directions, for about two minutes; needs 0.5 m of level floor around it"};

constexpr ToolsSubcommand kSelfTestSubcommand = {
    "self-test",
    "Test the robot: measure it at rest, turn each joint by 2 degrees and back, look at sensors "
    "and cameras; about a minute. It must be stiff and stand, best held or hung for the first "
    "time. Exit status 1: something is faulty"};

constexpr ToolsSubcommand kRobotSubcommand = {"robot", "Import and check the files of a robot"};

constexpr ToolsSubcommand kPolicySubcommand = {
    "policy", "Check a neural network that moves a robot, or draft one for a training"};

constexpr ToolsSubcommand kRecordSubcommand = {
    "record", "Record messages into a log until Ctrl-C; scripts/record knows the stack's bus"};

constexpr ToolsSubcommand kLogSubcommand = {
    "log", "Read and convert logs of scripts/record; needs no running robot"};

/** All of them, in the order of the help text. */
constexpr const ToolsSubcommand* kToolsSubcommands[] = {
    &kSpySubcommand,    &kCalibrateSubcommand, &kSelfTestSubcommand, &kRobotSubcommand,
    &kPolicySubcommand, &kRecordSubcommand,    &kLogSubcommand};

}  // namespace nao
