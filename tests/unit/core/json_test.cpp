#include "core/output/json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/output/files.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::core {
namespace {

TEST(Json, KeepsTheOrderGiven) {
  const char* text = R"({"b":[0.1,true,null],"a":1,"c":{}})";
  EXPECT_EQ(json_text({{"b", {0.1, true, nullptr}}, {"a", 1}, {"c", Json::object()}}), text);
  EXPECT_EQ(json_text(parse_json(text)), text);
}

TEST(Json, ReadsTheTextsThatItWrites) {
  const std::string text = "a\"b\\c\n\t\x01 \xce\xb5";
  EXPECT_EQ(json_text(text), "\"a\\\"b\\\\c\\n\\t\\u0001 \xce\xb5\"");
  EXPECT_EQ(text_of(parse_json(json_text(text))), text);
  EXPECT_EQ(json_text("case-\xff"), "\"case-\xef\xbf\xbd\"");  // the name of a file may be no UTF-8
}

TEST(Json, RefusesWhatIsNoNumber) {
  for (const double v : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)json_text(v), NumericsError);
    EXPECT_THROW((void)json_text({{"a", {1.0, v}}}), NumericsError);
  }
}

TEST(Json, NumbersReadBackToTheBit) {
  for (const double v : {0.1, 1.0 / 3, 1e-300, -2.5e17, 5e-324, 0.3, std::numeric_limits<double>::max()})
    EXPECT_EQ(number_of(parse_json(json_text(v))), v) << json_text(v);
  EXPECT_EQ(json_text({0.1, 0.3, 2.5e-8, std::numeric_limits<std::uint64_t>::max()}),
            "[0.1,0.3,2.5e-08,18446744073709551615]");
}

TEST(Json, WritesANumberThatMayBeMissing) {
  EXPECT_EQ(json_text({{"there", or_null(0.5)}, {"missing", or_null(std::nullopt)}}),
            R"({"there":0.5,"missing":null})");
}

TEST(Json, RefusesTextThatIsNoJson) {
  for (const char* text : {"", "{", "[1, 2", "[1 2]", "{\"a\": 1,}", "{1: 2}", "\"a", "tru", "nan", "inf", "1 2", "-",
                           "1e999", "\"\\x\"", "\"\\u00\"", "\"\xff\""})
    EXPECT_THROW((void)parse_json(text), FileError) << text;
}

TEST(Json, RefusesTooManyBrackets) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_NO_THROW((void)parse_json(nested(100)));
  EXPECT_THROW((void)parse_json(nested(102)), FileError);
  EXPECT_THROW((void)parse_json(nested(1000000)), FileError);
}

TEST(Json, ReadsAFileAndNamesTheOneThatIsWrong) {
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
  EXPECT_EQ(number_of(member_of(read_json(path), "a")), 2);
  const std::string wrong = path.string() + ": no \"polybed test\" of version 1";
  EXPECT_EQ(refusal(R"({"filetype": "polybed test", "version": 2})"), wrong);
  EXPECT_EQ(refusal(R"({"filetype": "polybed run", "version": 1})"), wrong);
  EXPECT_EQ(refusal("{}"), wrong);
  EXPECT_TRUE(refusal("{\"filetype\"").starts_with(path.string() + ": no JSON: parse error at line 1, column 12:"));
  EXPECT_THROW((void)read_json(scratch.path() / "none"), FileError);
}

TEST(Json, RefusesAnotherKindOfValue) {
  const Json value = parse_json(R"({"a": 1, "b": true, "c": [2]})");
  EXPECT_EQ(array_of(member_of(value, "c")).size(), 1U);
  EXPECT_THROW((void)member_of(value, "d"), FileError);
  EXPECT_THROW((void)member_of(member_of(value, "a"), "b"), FileError);
  EXPECT_THROW((void)text_of(member_of(value, "a")), FileError);
  EXPECT_THROW((void)array_of(value), FileError);
  for (const char* name : {"b", "c"}) EXPECT_THROW((void)number_of(member_of(value, name)), FileError);
}

}  // namespace
}  // namespace polybed::core
