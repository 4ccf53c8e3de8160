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

/** One value of a YAML file that knows where it stands, so that every complaint names the file, the
 * line and the key. Every function throws the error type given to load() if the file says something
 * else than is asked for. */
class YamlEntry {
 public:
  /** Reads a whole file.
   * @tparam ErrorType  What every complaint about the file is thrown as.
   * @throws ErrorType  if it is missing or not YAML. */
  template <class ErrorType = ModelError>
  static YamlEntry load(const std::filesystem::path& file) {
    return load(file, [](const std::string& text) { throw ErrorType(text); });
  }

  /** The same from a text, which complaints call `name`. */
  template <class ErrorType = ModelError>
  static YamlEntry parse(const std::string& text, const std::string& name) {
    return parse(text, name, [](const std::string& fault) { throw ErrorType(fault); });
  }

  /** Value of a key, which must be there. */
  YamlEntry at(const std::string& key) const;
  bool has(const std::string& key) const;
  /** Refuses keys that nobody reads (misspelt ones, most likely). */
  void allow_only(std::initializer_list<const char*> keys) const;

  /** Keys and values, in the file's order; a key that stands there twice is refused. */
  std::vector<std::pair<std::string, YamlEntry>> entries() const;
  std::vector<YamlEntry> items() const;
  std::string text() const;
  /** A finite number. */
  double number() const;
  /** A finite number above 0. */
  double positive() const;
  /** A finite number, 0 or above. */
  double not_negative() const;
  /** A list of exactly `count` finite numbers. */
  std::vector<double> numbers(size_t count) const;

  /** Complains about this value: "robot.yaml:12: motors.HeadYaw " and then `what`. */
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
