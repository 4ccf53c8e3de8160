#pragma once

#include <functional>
#include <string>

namespace nao {

class CommandLine;

/** Options of every program on the bus. */
struct CommonOptions {
  /** URL of the message bus. Default: LCM_DEFAULT_URL, otherwise a bus limited to this host. */
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  /** Minimum severity of printed log lines: trace, debug, info, warning, error. */
  std::string log_level = "info";
  /** Name of the robot: prefix of its channels. */
  std::string robot = "NAO";
};

/** Version of the whole project, such as "0.1.0". */
const char* version();

/** Adds --version and --log-level to the options of a program without a bus. */
void add_log_option(CommandLine& app, CommonOptions& options);

/** Adds those and --lcm-url to a program's options. */
void add_bus_options(CommandLine& app, CommonOptions& options);

/** Adds those and --robot to a program's options. */
void add_common_options(CommandLine& app, CommonOptions& options);

/** Adds --model, the folder of robots/ that describes the program's robot. @param model  Its
 * default. */
void add_model_option(CommandLine& app, std::string& model);

/** Runs a program: parses the command line, sets up logging to stderr, runs the body.
 *
 * @param app     Options, all added; its name is the program's.
 * @param common  The options that add_common_options() bound to `app`; read after parsing.
 * @param body    The program itself; an exception is printed as one line on stderr.
 * @return Exit status: 0 the body returned (or --help), 1 it threw, 2 the command line is wrong. */
int run_program(CommandLine& app, const CommonOptions& common, int argc, char** argv,
                const std::function<void()>& body);

/** As run_program(), for programs whose body returns the exit status (command-line clients). */
int run_program_with_status(CommandLine& app, const CommonOptions& common, int argc, char** argv,
                            const std::function<int()>& body);

}  // namespace nao
