#include "common/yaml_entry.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace nao {

YamlEntry YamlEntry::load(const std::filesystem::path& file, Thrower thrower) {
  const auto source = std::make_shared<const Source>(Source{file.string(), thrower});
  const YamlEntry nothing(YAML::Node(YAML::NodeType::Undefined), source, "");
  if (!std::filesystem::is_regular_file(file)) {
    nothing.fail("is missing");
  }
  try {
    return YamlEntry(YAML::LoadFile(file.string()), source, "");
  } catch (const YAML::Exception& error) {
    nothing.fail(std::string("is not YAML: ") + error.what());
  }
}

YamlEntry YamlEntry::parse(const std::string& text, const std::string& name, Thrower thrower) {
  const auto source = std::make_shared<const Source>(Source{name, thrower});
  try {
    return YamlEntry(YAML::Load(text), source, "");
  } catch (const YAML::Exception& error) {
    YamlEntry(YAML::Node(YAML::NodeType::Undefined), source, "")
        .fail(std::string("is not YAML: ") + error.what());
  }
}

// Linear search: files are small and are read at start.
YamlEntry YamlEntry::at(const std::string& key) const {
  for (const auto& [name, entry] : entries()) {
    if (name == key) {
      return entry;
    }
  }
  fail("lacks \"" + key + "\"");
}

bool YamlEntry::has(const std::string& key) const {
  const auto all = entries();
  return std::any_of(all.begin(), all.end(),
                     [&key](const auto& entry) { return entry.first == key; });
}

// A misspelled key would otherwise silently keep a default.
void YamlEntry::allow_only(std::initializer_list<const char*> keys) const {
  for (const auto& [name, entry] : entries()) {
    if (std::find(keys.begin(), keys.end(), name) == keys.end()) {
      entry.fail("is unknown");
    }
  }
}

std::vector<std::pair<std::string, YamlEntry>> YamlEntry::entries() const {
  if (!node_.IsMap()) {
    fail("must be a map of keys and values");
  }
  std::vector<std::pair<std::string, YamlEntry>> entries;
  std::set<std::string> names;
  for (const auto& pair : node_) {
    if (!pair.first.IsScalar()) {
      fail("has a key that is not a word");
    }
    const std::string& name = pair.first.Scalar();
    // Path from the root, such as "motors.HeadYaw": error messages name it.
    const YamlEntry entry(pair.second, source_, where_.empty() ? name : where_ + "." + name);
    // YAML forbids equal keys, but the parser accepts them.
    if (!names.insert(name).second) {
      entry.fail("appears twice");
    }
    entries.emplace_back(name, entry);
  }
  return entries;
}

std::vector<YamlEntry> YamlEntry::items() const {
  if (!node_.IsSequence()) {
    fail("must be a list");
  }
  std::vector<YamlEntry> items;
  for (const YAML::Node& item : node_) {
    items.push_back(YamlEntry(item, source_, where_ + "[" + std::to_string(items.size()) + "]"));
  }
  return items;
}

std::string YamlEntry::text() const {
  // An empty value is a forgotten one.
  if (!node_.IsScalar() || node_.Scalar().empty()) {
    fail("must be a non-empty string");
  }
  return node_.Scalar();
}

bool YamlEntry::flag() const {
  const std::string value = text();
  if (value != "true" && value != "false") fail("is neither true nor false");
  return value == "true";
}

double YamlEntry::number() const {
  double value = 0;
  if (!node_.IsScalar() || !YAML::convert<double>::decode(node_, value)) {
    fail("must be a number");
  }
  // YAML knows .nan and .inf: in a model they would reach the motors.
  if (!std::isfinite(value)) {
    fail("must be finite");
  }
  return value;
}

double YamlEntry::positive() const {
  const double value = number();
  if (value <= 0) {
    fail("must be greater than 0");
  }
  return value;
}

double YamlEntry::not_negative() const {
  const double value = number();
  if (value < 0) {
    fail("must not be negative");
  }
  return value;
}

std::vector<double> YamlEntry::numbers() const {
  std::vector<double> numbers;
  for (const YamlEntry& item : items()) numbers.push_back(item.number());
  return numbers;
}

std::vector<double> YamlEntry::numbers(size_t count) const {
  std::vector<double> all = numbers();
  if (all.size() != count) fail("must be " + std::to_string(count) + " numbers");
  return all;
}

void YamlEntry::fail(const std::string& what) const {
  const YAML::Mark mark = node_.Mark();
  // Marks count lines from 0, editors from 1.
  const std::string line = mark.is_null() ? "" : ":" + std::to_string(mark.line + 1);
  source_->thrower(source_->file + line + ": " + (where_.empty() ? "the file" : where_) + " " +
                   what);
  // Unreachable: every thrower throws.
  std::abort();
}

}  // namespace nao
