#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"

namespace nao {

/** One value of a YAML file with its position, so that every error names the file, the line and the
 * key. Every function throws the error type given to load() if the value has another type. */
class YamlEntry {
 public:
  /** Reads a whole file.
   * @tparam ErrorType  Type of all exceptions about the file.
   * @throws ErrorType  if it is missing or not YAML. */
  template <class ErrorType = ModelError>
  static YamlEntry load(const std::filesystem::path& file) {
    return load(file, [](const std::string& text) { throw ErrorType(text); });
  }

  /** Parses a text; errors name it `name`. */
  template <class ErrorType = ModelError>
  static YamlEntry parse(const std::string& text, const std::string& name) {
    return parse(text, name, [](const std::string& fault) { throw ErrorType(fault); });
  }

  /** Value of a key, which must exist. */
  YamlEntry at(const std::string& key) const;
  bool has(const std::string& key) const;
  /** Rejects all other keys, which are probably misspelled. */
  void allow_only(std::initializer_list<const char*> keys) const;

  /** Keys and values, in the file's order; a key that appears twice is refused. */
  std::vector<std::pair<std::string, YamlEntry>> entries() const;
  std::vector<YamlEntry> items() const;
  bool is_list() const { return node_.IsSequence(); }
  std::string text() const;
  /** "true" or "false". */
  bool flag() const;
  /** A finite number. */
  double number() const;
  /** A finite number above 0. */
  double positive() const;
  /** A finite number, 0 or above. */
  double not_negative() const;
  /** A list of finite numbers. */
  std::vector<double> numbers() const;
  /** A list of exactly `count` finite numbers. */
  std::vector<double> numbers(size_t count) const;

  /** Throws an error about this value: "robot.yaml:12: motors.HeadYaw " and then `what`. */
  [[noreturn]] void fail(const std::string& what) const;

 private:
  using Thrower = void (*)(const std::string&);
  struct Source {
    std::string file;
    Thrower thrower;
  };

  static YamlEntry load(const std::filesystem::path& file, Thrower thrower);
  static YamlEntry parse(const std::string& text, const std::string& name, Thrower thrower);
  YamlEntry(const YAML::Node& node, std::shared_ptr<const Source> source, std::string where)
      : node_(node), source_(std::move(source)), where_(std::move(where)) {}

  YAML::Node node_;
  std::shared_ptr<const Source> source_;
  /** Keys from the root, "motors.HeadYaw"; empty for the root. */
  std::string where_;
};

}  // namespace nao
