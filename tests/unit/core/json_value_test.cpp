#include "core/json_value.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/json.hpp"

namespace polybed::core {
namespace {

TEST(JsonValue, ReadsWhatTheWriterWrites) {
  Json json;
  json.begin_object().member("a", 1).key("b").begin_array().value(0.1).value(true).null().end_array();
  json.member("text", "a\"b\\c\n\t\x01 \xce\xb5").key("none").begin_object().end_object().end_object();
  const JsonValue value = parse_json(json.text() + "\n");
  EXPECT_EQ(value.of("a").number(), 1);
  ASSERT_EQ(value.of("b").array().size(), 3U);
  EXPECT_EQ(value.of("b").array()[0].number(), 0.1);
  EXPECT_TRUE(value.of("b").array()[1].truth());
  EXPECT_TRUE(value.of("b").array()[2].is_null());
  EXPECT_EQ(value.of("text").text(), "a\"b\\c\n\t\x01 \xce\xb5");
  EXPECT_TRUE(value.of("none").object().empty());
}

TEST(JsonValue, RefusesWhatIsNoJson) {
  for (const char* text : {"", "{", "[1, 2", "[1 2]", "{\"a\": 1,}", "{1: 2}", "\"a", "tru", "nan", "inf", "1 2", "-",
                           "\"\\x\"", "\"\\u00\"", "\"\\u0416\""})
    EXPECT_THROW((void)parse_json(text), FileError) << text;
  EXPECT_THROW((void)parse_json(std::string(100000, '[')), FileError);
}

TEST(JsonValue, RefusesAnotherKindOfValue) {
  const JsonValue value = parse_json("{\"a\": 1}");
  EXPECT_THROW((void)value.of("b"), FileError);
  EXPECT_THROW((void)value.of("a").text(), FileError);
  EXPECT_THROW((void)value.number(), FileError);
}

}  // namespace
}  // namespace polybed::core
