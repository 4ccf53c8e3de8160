#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include "common/parameter_group.h"
#include "common/yaml_entry.h"

namespace nao {

/** Entry "GROUP.KEY" of a file. Errors report one that the file does not have. */
inline YamlEntry parameter_entry(const YamlEntry& root, const std::string& name) {
  const size_t dot = name.find('.');
  return root.at(name.substr(0, dot)).at(name.substr(dot + 1));
}

/** Calls `read` with each parameter of a file and its entry, in the file's order. An unknown name
 * is an error: a misspelled parameter would silently keep its default. */
template <class Parameters, class Read>
void read_parameters(const YamlEntry& root, const ParameterTable<Parameters>& table, Read read) {
  for (const auto& [group, keys] : root.entries()) {
    for (const auto& [key, entry] : keys.entries()) {
      const auto known = std::find_if(
          table.begin(), table.end(),
          [name = group + "." + key](const auto& parameter) { return parameter.name == name; });
      if (known == table.end()) entry.fail("is unknown");
      read(*known, entry);
    }
  }
}

/** The numbers of a file that states all of them; `robot_file`, if it exists, replaces single ones.
 * @throws ModelError  if the first lacks a number, or one is unknown, negative or not finite. */
template <class Parameters>
Parameters load_parameters(const std::filesystem::path& file,
                           const std::filesystem::path& robot_file,
                           const ParameterTable<Parameters>& table) {
  Parameters parameters;
  const auto read = [&](const YamlEntry& root) {
    read_parameters(root, table, [&](const auto& known, const YamlEntry& entry) {
      known.in(parameters) = entry.not_negative();
    });
  };
  const YamlEntry common = YamlEntry::load(file);
  read(common);
  for (const auto& parameter : table) (void)parameter_entry(common, parameter.name);
  if (std::filesystem::exists(robot_file)) read(YamlEntry::load(robot_file));
  return parameters;
}

}  // namespace nao
