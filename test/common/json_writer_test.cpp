#include "common/json_writer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao {
namespace {

TEST(JsonWriter, NestsObjectsAndArrays) {
  JsonWriter json;
  json.begin_object();
  json.add("a", 1);
  json.begin_array("b");
  json.add("", "x");
  json.begin_object();
  json.end();
  json.end();
  json.add("c", true);
  json.end();
  EXPECT_EQ(json.text(), R"({"a":1,"b":["x",{}],"c":true})");
}

TEST(JsonWriter, EscapesQuotesAndControlCharacters) {
  JsonWriter json;
  json.add("", "say \"no\"\\\n");
  EXPECT_EQ(json.text(), R"("say \"no\"\\\n")");
}

TEST(JsonWriter, ReplacesBytesThatAreNotUtf8) {
  JsonWriter json;
  json.add("", "a\xff");
  EXPECT_EQ(json.text(), "\"a\xef\xbf\xbd\"");
}

TEST(JsonWriter, KeepsAllDigitsAndWritesNanAsNull) {
  JsonWriter json;
  const double values[] = {0.1, 1.0 / 3, std::nan(""), -INFINITY};
  json.add("", values, 4);
  EXPECT_EQ(json.text(), "[0.1,0.3333333333333333,null,null]");
}

}  // namespace
}  // namespace nao
