#include "common/json_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

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
  // The outer object is unfinished.
  EXPECT_EQ(json.take(), R"({"a":1,"b":["x",{}],"c":true})");
}

TEST(JsonWriter, EscapesQuotesAndControlCharacters) {
  JsonWriter json;
  json.add("", "say \"no\"\\\n");
  EXPECT_EQ(json.take(), R"("say \"no\"\\\n")");
}

TEST(JsonWriter, ReplacesBytesThatAreNotUtf8) {
  JsonWriter json;
  json.add("", "a\xff");
  EXPECT_EQ(json.take(), "\"a\xef\xbf\xbd\"");
}

TEST(JsonWriter, KeepsAllDigitsAndWritesNanAsNull) {
  JsonWriter json;
  const double values[] = {0.1, 1.0 / 3, std::nan(""), -INFINITY};
  json.add("", values, 4);
  EXPECT_EQ(json.take(), "[0.1,0.3333333333333333,null,null]");
}

TEST(JsonWriter, WritesNumbersThatReadBackEqual) {
  for (const double value : {0.0, -1.0, 1e5, 1e-7, 1e300, 5e-324, 123456.75, 2.0 / 3}) {
    JsonWriter json;
    json.add("", value);
    const std::string text = json.take();
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
    EXPECT_NE(text.find_first_of(".e"), std::string::npos) << text;
  }
}

TEST(JsonWriter, WritesBytesAsBase64) {
  // RFC 4648, section 10.
  const auto base64 = [](const std::string& text) {
    JsonWriter json;
    json.add_base64("", {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
    return json.take();
  };
  EXPECT_EQ(base64(""), R"("")");
  EXPECT_EQ(base64("f"), R"("Zg==")");
  EXPECT_EQ(base64("fo"), R"("Zm8=")");
  EXPECT_EQ(base64("foo"), R"("Zm9v")");
  EXPECT_EQ(base64("foobar"), R"("Zm9vYmFy")");
}

TEST(JsonWriter, TakesValuesThatAreJson) {
  JsonWriter json;
  json.begin_array();
  json.add_json("", R"({"a":[]})");
  json.add_json("", "1");
  json.end();
  EXPECT_EQ(json.take(), R"([{"a":[]},1])");
}

}  // namespace
}  // namespace nao
