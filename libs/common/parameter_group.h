#pragma once

#include <array>
#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace nao {

/** A number of a struct of groups, and its name in a YAML file: "GROUP.KEY". */
template <class Parameters>
struct NamedParameter {
  std::string name;
  std::function<double&(Parameters&)> in;
};

template <class Parameters>
using ParameterTable = std::vector<NamedParameter<Parameters>>;

template <class Parameters, class Group>
using GroupMember = Group Parameters::*;

/** Adds the parameters of a group that NAO_PARAMETER_GROUP() declares. */
template <class Parameters, class Group>
void add_group(const std::string& name, GroupMember<Parameters, Group> group,
               ParameterTable<Parameters>& table) {
  for (const auto& [key, number] : Group::numbers()) {
    table.push_back({name + "." + key, [group, number = number](Parameters& all) -> double& {
                       return all.*group.*number;
                     }});
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): names cannot be in parentheses.
#define NAO_DECLARE_NUMBER(r, data, key) double key = 0;
#define NAO_NAME_NUMBER(r, Group, key) std::pair(BOOST_PP_STRINGIZE(key), &Group::key),
#define NAO_ADD_GROUP(r, Parameters, group) \
  add_group(BOOST_PP_STRINGIZE(group), &Parameters::group, table);

/** Declares a group in a struct of parameters: a type with a number for each of the keys, which are
 * those of the file, and a member of that type. */
#define NAO_PARAMETER_GROUP(Group, group, ...)                                                     \
  struct Group {                                                                                   \
    BOOST_PP_SEQ_FOR_EACH(NAO_DECLARE_NUMBER, , BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))             \
    static auto numbers() {                                                                        \
      return std::to_array<std::pair<const char*, double Group::*>>(                               \
          {BOOST_PP_SEQ_FOR_EACH(NAO_NAME_NUMBER, Group, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))}); \
    }                                                                                              \
  };                                                                                               \
  Group group

/** Defines all_parameters(), the table of a struct of parameters. @param ...  Its groups. */
#define NAO_PARAMETER_TABLE(Parameters, ...)                                                  \
  const ParameterTable<Parameters>& all_parameters() {                                        \
    static const ParameterTable<Parameters> all = [] {                                        \
      ParameterTable<Parameters> table;                                                       \
      BOOST_PP_SEQ_FOR_EACH(NAO_ADD_GROUP, Parameters, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__)) \
      return table;                                                                           \
    }();                                                                                      \
    return all;                                                                               \
  }
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace nao
