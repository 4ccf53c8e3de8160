#include "common/command_line.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <deque>
#include <iostream>
#include <type_traits>
#include <utility>

namespace nao {

// CLI11 is hidden behind this file: its header is slow to compile.
struct CommandLine::Parts {
  /** Parser of a program; its subcommands belong to it. */
  std::unique_ptr<CLI::App> own_app;
  CLI::App& app;
  std::deque<Option> options;
  std::vector<std::unique_ptr<CommandLine>> subcommands;
};

namespace {

std::function<void()> with_usage_errors(std::function<void()> act) {
  return [act = std::move(act)] {
    try {
      act();
    } catch (const UsageError& error) {
      // CLI11 reports its own exceptions with the usage and status 2.
      throw CLI::ValidationError(error.option, error.what());
    }
  };
}

// CLI11 says only that a subcommand is missing where the word in its place is not one.
bool refuse_unknown_subcommand(CLI::App& program) {
  CLI::App* app = &program;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  const std::vector<std::string> unknown = app->remaining();
  const std::vector<CLI::App*> known = app->get_subcommands(nullptr);
  if (unknown.empty() || known.empty()) return false;
  std::cerr << "'" << unknown.front() << "' is not one of";
  for (const CLI::App* command : known) {
    if (!command->get_name().empty()) std::cerr << " " << command->get_name();
  }
  std::cerr << "\nRun with --help for more information.\n";
  return true;
}

// Whether a default is worth showing: no text, no list and no finite number stand for "not given".
template <class Variable>
bool has_value(const Variable& variable) {
  if constexpr (std::is_floating_point_v<Variable>) {
    return std::isfinite(variable);
  } else if constexpr (!std::is_integral_v<Variable>) {
    return !variable.empty();
  }
  return true;
}

}  // namespace

CommandLine::Option* CommandLine::Option::required() {
  option_.required()->default_str("");
  return this;
}

CommandLine::Option* CommandLine::Option::from_environment(const std::string& variable) {
  option_.envname(variable);
  return this;
}

CommandLine::Option* CommandLine::Option::count(int least, int most) {
  option_.expected(least, most);
  return this;
}

CommandLine::Option* CommandLine::Option::separated_by(char delimiter) {
  option_.delimiter(delimiter);
  return this;
}

CommandLine::Option* CommandLine::Option::needs(const Option* other) {
  option_.needs(&other->option_);
  return this;
}

CommandLine::Option* CommandLine::Option::needs(const std::string& name) {
  option_.needs(name);
  return this;
}

CommandLine::Option* CommandLine::Option::range(int least, int greatest) {
  option_.check(CLI::Range(least, greatest));
  return this;
}

CommandLine::Option* CommandLine::Option::range(double least, double greatest) {
  option_.check(CLI::Range(least, greatest));
  return this;
}

CommandLine::Option* CommandLine::Option::positive() {
  option_.check(CLI::PositiveNumber);
  // Stands for "not given", too.
  if (option_.get_default_str() == "0") option_.default_str("");
  return this;
}

CommandLine::Option* CommandLine::Option::not_negative() {
  option_.check(CLI::NonNegativeNumber);
  return this;
}

CommandLine::Option* CommandLine::Option::existing_file() {
  option_.check(CLI::ExistingFile);
  return this;
}

CommandLine::Option* CommandLine::Option::one_of(std::vector<std::string> choices) {
  option_.check(CLI::IsMember(std::move(choices)));
  return this;
}

CommandLine::Option* CommandLine::Option::check(
    std::function<std::string(const std::string&)> fault, const std::string& shown) {
  option_.check(CLI::Validator(
      [fault = std::move(fault)](std::string& value) { return fault(value); }, shown));
  return this;
}

CommandLine::CommandLine(const std::string& description, const std::string& name) {
  auto app = std::make_unique<CLI::App>(description, name);
  CLI::App& reference = *app;
  parts_ = std::unique_ptr<Parts>(new Parts{std::move(app), reference, {}, {}});
}

CommandLine::CommandLine(CLI::App& app)
    : parts_(std::unique_ptr<Parts>(new Parts{nullptr, app, {}, {}})) {}

CommandLine::~CommandLine() = default;

std::string CommandLine::name() const {
  return parts_->app.get_name();
}

CommandLine::Option* CommandLine::keep(CLI::Option* option) {
  // A deque: addresses of its elements stay valid.
  return &parts_->options.emplace_back(*option);
}

template <class Variable>
CommandLine::Option* CommandLine::add_option(const std::string& name, Variable& variable,
                                             const std::string& help) {
  CLI::Option* option = parts_->app.add_option(name, variable, help);
  if (has_value(variable) && help.find("default:") == std::string::npos) {
    option->capture_default_str();
  }
  return keep(option);
}

#define NAO_OPTION_TYPE(Variable)                                                      \
  template CommandLine::Option* CommandLine::add_option(const std::string&, Variable&, \
                                                        const std::string&);
NAO_OPTION_TYPE(std::string)
NAO_OPTION_TYPE(uint16_t)
NAO_OPTION_TYPE(int32_t)
NAO_OPTION_TYPE(uint32_t)
NAO_OPTION_TYPE(int64_t)
NAO_OPTION_TYPE(uint64_t)
NAO_OPTION_TYPE(double)
NAO_OPTION_TYPE(std::vector<std::string>)
NAO_OPTION_TYPE(std::vector<int>)
NAO_OPTION_TYPE(std::vector<double>)

CommandLine::Option* CommandLine::add_flag(const std::string& name, bool& variable,
                                           const std::string& help) {
  return keep(parts_->app.add_flag(name, variable, help));
}

void CommandLine::add_version_flag(const std::string& name, const std::string& version) {
  parts_->app.set_version_flag(name, version);
}

CommandLine* CommandLine::add_subcommand(const std::string& name, const std::string& help) {
  CLI::App* app = parts_->app.add_subcommand(name, help);
  parts_->subcommands.push_back(std::unique_ptr<CommandLine>(new CommandLine(*app)));
  return parts_->subcommands.back().get();
}

CommandLine* CommandLine::add_delegated_subcommand(const std::string& name,
                                                   const std::string& help) {
  CommandLine* command = add_subcommand(name, help);
  command->parts_->app.set_help_flag();
  command->parts_->app.fallthrough(false);
  command->parts_->app.prefix_command();
  return command;
}

void CommandLine::require_subcommand() {
  parts_->app.require_subcommand(1);
}

void CommandLine::share_options() {
  parts_->app.fallthrough();
}

void CommandLine::footer(const std::string& text) {
  parts_->app.footer(text);
}

void CommandLine::on_parsed(std::function<void()> act) {
  parts_->app.callback(with_usage_errors(std::move(act)));
}

// Status 0 after --help and --version, 2 after a wrong command line; nothing if the program is to
// run.
std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
  try {
    parts_->app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    if (!refuse_unknown_subcommand(parts_->app)) parts_->app.exit(error);
    return 2;
  } catch (const CLI::ParseError& error) {
    return parts_->app.exit(error) == 0 ? 0 : 2;
  }
  return std::nullopt;
}

}  // namespace nao
