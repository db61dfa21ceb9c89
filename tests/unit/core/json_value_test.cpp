#include "core/output/json_value.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "tests/unit/core/scratch.hpp"

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

TEST(JsonValue, WritesANumberThatMayBeMissing) {
  const std::optional<double> missing;
  Json json;
  json.begin_object().member("there", std::optional(0.5)).member("missing", missing).end_object();
  EXPECT_EQ(json.text(), R"({"there": 0.5, "missing": null})");
}

TEST(JsonValue, ReadsAFileAndNamesTheOneThatIsWrong) {
  const test::Scratch scratch;
  const std::filesystem::path path = scratch.path() / "a.json";
  const auto refusal = [&](const std::string& text) -> std::string {
    write_atomically(path, text);
    try {
      static_cast<void>(read_json(path, "polybed test"));
    } catch (const FileError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(refusal(R"({"filetype": "polybed test", "version": 1, "a": 2})"), "none");
  EXPECT_EQ(read_json(path).of("a").number(), 2);
  EXPECT_EQ(read_text(path), R"({"filetype": "polybed test", "version": 1, "a": 2})");
  const std::string wrong = path.string() + ": no \"polybed test\" of version 1";
  EXPECT_EQ(refusal(R"({"filetype": "polybed test", "version": 2})"), wrong);
  EXPECT_EQ(refusal(R"({"filetype": "polybed run", "version": 1})"), wrong);
  EXPECT_EQ(refusal("{}"), wrong);
  EXPECT_TRUE(refusal("{\"filetype\"").starts_with(path.string() + ": no JSON at byte"));
  EXPECT_THROW((void)read_json(scratch.path() / "none"), FileError);
}

TEST(JsonValue, RefusesAnotherKindOfValue) {
  const JsonValue value = parse_json("{\"a\": 1}");
  EXPECT_THROW((void)value.of("b"), FileError);
  EXPECT_THROW((void)value.of("a").text(), FileError);
  EXPECT_THROW((void)value.number(), FileError);
}

}  // namespace
}  // namespace polybed::core
