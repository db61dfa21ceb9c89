#include "core/output/json.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace polybed::core {
namespace {

TEST(Json, WritesNestedValuesInTheOrderGiven) {
  Json json;
  json.begin_object().member("a", 1).key("b").begin_array().value(0.1).value(true).null().end_array();
  json.key("c").begin_object().end_object().member("d", "x").end_object();
  EXPECT_EQ(json.text(), R"({"a": 1, "b": [0.1, true, null], "c": {}, "d": "x"})");
}

TEST(Json, EscapesText) {
  Json json;
  json.value(std::string("a\"b\\c\n\t\x01"));
  EXPECT_EQ(json.text(), R"("a\"b\\c\n\u0009\u0001")");
}

TEST(Json, RefusesWhatIsNoNumber) {
  Json json;
  EXPECT_THROW(json.value(std::numeric_limits<double>::quiet_NaN()), NumericsError);
  EXPECT_THROW(json.value(std::numeric_limits<double>::infinity()), NumericsError);
}

TEST(Json, NumbersReadBackToTheBit) {
  for (const double v : {0.1, 1.0 / 3, 1e-300, -2.5e17, 2.5e-308, std::numeric_limits<double>::max()}) {
    Json json;
    json.value(v);
    EXPECT_EQ(std::stod(json.text()), v) << json.text();
  }
}

}  // namespace
}  // namespace polybed::core
