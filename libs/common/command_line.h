#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace nao {

/** Thrown by a callback for an invalid argument: "theta", "'x' is not an angle". */
struct UsageError : std::runtime_error {
  UsageError(std::string option_name, const std::string& what)
      : std::runtime_error(what), option(std::move(option_name)) {}

  std::string option;
};

/** Command line of a program or of one of its subcommands: options, arguments and help text.
 *
 * Variables that options fill must outlive parsing. The implementation is CLI11. Only
 * command_line.cpp includes its headers, which take several seconds to compile. */
class CommandLine {
 public:
  /** An option, argument or flag that was added; lives as long as its command line. */
  class Option {
   public:
    explicit Option(CLI::Option& option) : option_(option) {}

    Option* required();
    /** This environment variable gives the value where the command line does not. */
    Option* from_environment(const std::string& variable);
    /** Takes this many values. */
    Option* count(int least, int most);
    Option* count(int number) { return count(number, number); }
    /** One word may hold several values, with this letter between them. */
    Option* separated_by(char delimiter);
    /** May only be given together with that one. */
    Option* needs(const Option* other);
    Option* needs(const std::string& name);

    Option* range(int least, int greatest);
    Option* range(double least, double greatest);
    /** Greater than 0. */
    Option* positive();
    /** 0 or greater. */
    Option* not_negative();
    Option* existing_file();
    Option* one_of(std::vector<std::string> choices);
    /** @param fault  Says what is wrong with a value; empty: nothing.
     * @param shown  In the help text, such as "NAME"; may be empty. */
    Option* check(std::function<std::string(const std::string&)> fault,
                  const std::string& shown = "");

   private:
    CLI::Option& option_;
  };

  /** A program. */
  CommandLine(const std::string& description, const std::string& name);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  std::string name() const;

  /** Adds an option ("--seeds") or argument ("seeds") that fills a variable; one of a vector may be
   * repeated, and takes several values unless limited by count(). The help text shows the
   * variable's present value, unless the option is required or `help` says what the default is.
   * @tparam Variable  std::string, double, an integer of 16 to 64 bits, or a vector of std::string,
   * int or double. */
  template <class Variable>
  Option* add_option(const std::string& name, Variable& variable, const std::string& help);
  /** Adds a flag that sets a variable; "!--no-follow" clears it. */
  Option* add_flag(const std::string& name, bool& variable, const std::string& help);
  /** Adds a flag that prints this and ends the program. */
  void add_version_flag(const std::string& name, const std::string& version);

  /** @return The subcommand; lives as long as this. */
  CommandLine* add_subcommand(const std::string& name, const std::string& help);
  /** Adds a subcommand that another program reads: it takes whatever follows its name, --help too.
   * @return The subcommand; lives as long as this. */
  CommandLine* add_delegated_subcommand(const std::string& name, const std::string& help);
  /** One of the subcommands must be named. */
  void require_subcommand();
  /** Subcommands take options of this one too. */
  void share_options();
  /** Ends the help text. */
  void footer(const std::string& text);
  /** Called when this was named and all its options are read. It may throw UsageError. */
  void on_parsed(std::function<void()> act);

  /** Reads the command line.
   * @return None: run the program. Otherwise the exit status to end with, the reason is printed:
   * 0 for --help and --version, 2 if the command line is wrong. */
  std::optional<int> parse(int argc, const char* const* argv);

 private:
  struct Parts;

  explicit CommandLine(CLI::App& app);
  Option* keep(CLI::Option* option);

  std::unique_ptr<Parts> parts_;
};

}  // namespace nao
