// Law files: what is read, and what is said of a wrong one, with its place.
#include "relevance/drag_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "core/error.hpp"
#include "relevance/drag_law.hpp"

namespace polybed::relevance {
namespace {

using testing::HasSubstr;

class LawFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = testing::TempDir() + "law-" + test->name() + ".json";
  }
  void TearDown() override { std::filesystem::remove(path_); }

  [[nodiscard]] std::string name() const { return "file:" + path_; }

  void write(const std::string& text) const { std::ofstream(path_) << text; }

  /// What is said of a file.
  [[nodiscard]] std::string said_of(const std::string& text) const {
    write(text);
    try {
      (void)read_drag_file(path_);
    } catch (const core::CaseError& error) {
      return error.what();
    }
    return "nothing";
  }

  static std::string head() { return "{\"filetype\": \"polybed drag law\", \"version\": 1,\n"; }

  /// A file of a form with its published constants, a line each from line 4 on.
  static std::string published(const std::string& form) {
    std::string text = head() + " \"form\": \"" + form + "\", \"constants\": {";
    for (const closures::DragForm& f : closures::drag_forms())
      for (const closures::DragFormConstant& c : f.constants)
        if (f.name == form)
          text += (text.back() == '{' ? "\n  \"" : ",\n  \"") + c.name + "\": " + std::to_string(c.published);
    return text + "}}\n";
  }

  std::string path_;
};

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(LawFile, IsReadAsALawOfOneSizeAndOfMixtures) {
  const std::string text = published("brinkman_oseen");
  write(changed(text, "\"stretch\": 0.766400", "\"stretch\": 0.8"));
  const closures::DragLaw law = drag_law_named(name());
  std::map<std::string, double> constants;
  const std::vector<closures::DragForm> forms = closures::drag_forms();
  for (const closures::DragFormConstant& c : forms[1].constants) constants[c.name] = c.published;
  constants["stretch"] = 0.8;
  const closures::DragLaw expected = closures::fitted_drag_law("brinkman_oseen", constants, closures::Guard::on);
  EXPECT_EQ(closures::pure_drag_at(law, 0.6, 50), closures::pure_drag_at(expected, 0.6, 50));
  EXPECT_TRUE(drag_law_named(name(), "cello").partition);
  EXPECT_THROW((void)drag_law_named(name(), "syamlal"), std::invalid_argument);
}

TEST_F(LawFile, MovesALawOfTheMenu) {
  write(head() + "\"law\": \"wen_yu\", \"common\": 1.1, \"tilt\": -0.05}");
  const closures::DragLaw law = drag_law_named(name(), "brinkman_oseen");
  EXPECT_NEAR(closures::pure_drag_at(law, 0.8, 20),
              1.1 * closures::pure_drag_at(closures::drag_law("wen_yu", closures::Guard::on), 0.8, 20), 1e-12);
  EXPECT_TRUE(law.partition);
  EXPECT_EQ(law.tilt, -0.05);
  write(head() + "\"law\": \"syamlal\"}");
  EXPECT_THROW((void)drag_law_named(name(), "brinkman_oseen"), std::invalid_argument);
}

TEST_F(LawFile, RecordHasHashAndConstants) {
  write(published("cello"));
  const std::string record = record_of(path_, read_drag_file(path_));
  EXPECT_THAT(record, HasSubstr("\"k1_linear\":128"));
  EXPECT_THAT(record, HasSubstr("\"hash\":\"" + read_drag_file(path_).hash));
}

/// Evaluations outside the range at one point, in a cell and on a particle of 1 mm in liquid of 1000 kg/m3 and 1 mPa s.
std::array<std::uint64_t, 3> outside_of(const closures::DragLaw& law, double voidage, double reynolds) {
  std::array<closures::GuardCount, 3> counts;
  double f = 0, slope = 0;
  const double one = 1, diameter = 1e-3, per = 1e3, per_square = 1e6, slip = 1e-3 * reynolds;
  closures::drag_of_points(law, {&voidage, 1}, {&reynolds, 1}, {&f, 1}, {&slope, 1}, counts[0]);
  const double *shares[] = {&one}, *slips[] = {&slip};
  double* fs[] = {&f};
  closures::drag_of_cells(law, {&voidage, 1}, shares, slips, {&diameter, 1}, 1e3, 1e-3, fs, counts[1]);
  closures::drag_of_particles(law, {&voidage, 1}, {&per, 1}, {&diameter, 1}, {&per_square, 1}, diameter, {&one, 1},
                              {&diameter, 1}, {&slip, 1}, 1e3, 1e-3, {&f, 1}, counts[2]);
  for (const closures::GuardCount& count : counts) EXPECT_EQ(count.evaluations, 1);
  return {counts[0].guarded, counts[1].guarded, counts[2].guarded};
}

TEST_F(LawFile, RangeOfTheRowsCounts) {
  using Counts = std::array<std::uint64_t, 3>;
  const std::string range = ", \"range\": {\"voidage\": [0.6, 0.8], \"reynolds\": [0, 5]}}";
  for (const std::string form : {"cello", "brinkman_oseen"}) {
    write(published(form));
    const closures::DragLaw unknown = drag_law_named(name());
    EXPECT_EQ(fitted_range(unknown), "unknown");
    EXPECT_EQ(outside_of(unknown, 0.7, 100), (Counts{0, 0, 0})) << "within the form";
    write(changed(published(form), "}}", "}" + range));
    for (const char* partition : {"none", "vbk_theory"}) {
      const closures::DragLaw law = drag_law_named(name(), partition);
      EXPECT_EQ(fitted_range(law), "voidage 0.6 to 0.8, Re 0 to 5");
      EXPECT_EQ(outside_of(law, 0.7, 4), (Counts{0, 0, 0})) << form << partition;
      EXPECT_EQ(outside_of(law, 0.7, 6), (Counts{1, 1, 1})) << form << partition;
      EXPECT_EQ(outside_of(law, 0.5, 4), (Counts{1, 1, 1})) << form << partition;
      EXPECT_EQ(outside_of(law, 0.9, 4), (Counts{1, 1, 1})) << form << partition;
      EXPECT_EQ(closures::pure_drag_at(law, 0.9, 500), closures::pure_drag_at(unknown, 0.9, 500));
    }
  }
  EXPECT_THAT(record_of(path_, read_drag_file(path_)),
              HasSubstr("\"range\":{\"voidage\":[0.6,0.8],\"reynolds\":[0.0,5.0]}"));
  EXPECT_EQ(fitted_range(drag_law_named("cello")), "");
}

TEST_F(LawFile, SaysWhatIsWrongAndWhere) {
  const std::string good = published("cello");
  EXPECT_EQ(said_of(good), "nothing");
  EXPECT_THAT(said_of(changed(good, "\"k1_square\": 715.000000", "\"k1_square\": -715")),
              HasSubstr(path_ + ":4:3: constants.k1_square = -715: expected a number above 0"));
  EXPECT_THAT(said_of(changed(good, "k1_square", "k1_squared")),
              HasSubstr(":4:3: unknown constant 'k1_squared'; did you mean 'k1_square'?"));
  EXPECT_THAT(said_of(changed(good, "k1_square", "k1_squared")), HasSubstr("constants.k1_square is missing"));
  EXPECT_THAT(said_of(changed(good, "715.000000", "\"many\"")), HasSubstr("constants.k1_square = \"many\""));
  EXPECT_THAT(said_of(changed(good, "\"cello\"", "\"celo\"")), HasSubstr(":2:2: unknown form 'celo'; did you mean"));
  EXPECT_THAT(said_of(changed(good, "715.000000", "715 716")), HasSubstr(path_ + ":4:"));
  EXPECT_THAT(said_of(changed(good, "\"version\": 1", "\"version\": 2")), HasSubstr(":1:34: version"));
  EXPECT_THAT(said_of("[]"), HasSubstr(":1:1: expected an object"));
  EXPECT_THAT(said_of("{}"), HasSubstr("no drag law"));
  EXPECT_THAT(said_of(head() + "\"law\": \"wen_yu\", \"comon\": 1.1}"), HasSubstr("did you mean 'common'?"));
  EXPECT_THAT(said_of(head() + "\"law\": \"wen_yu\",\n\"tilt\": 3}"), HasSubstr(":3:1: tilt = 3"));
  EXPECT_THAT(said_of(head() + "\"law\": \"wen_you\"}"), HasSubstr("did you mean 'wen_yu'?"));
  EXPECT_THAT(said_of(head() + "\"tilt\": 0}"), HasSubstr("either \"form\""));
  EXPECT_THAT(said_of(head() + "\"law\": \"wen_yu\",\n\"range\": {\"voidage\": [0.4, 0.9]}}"),
              HasSubstr(":3:1: range: exp"));
  for (const char* voidage : {"[0.9, 0.4]", "[0.4, 2]", "[-1, 0.4]", "[0.4]", "0.4", "[0.4, \"b\"]"})
    EXPECT_THAT(
        said_of(head() + "\"law\": \"wen_yu\",\n\"range\": {\"reynolds\": [0, 5], \"voidage\": " + voidage + "}}"),
        HasSubstr("range.voidage = "));
  EXPECT_THAT(said_of(changed(good, "\"k3_voidage\": 410", "\"k3_voidage\": 2050")),
              HasSubstr("falls there as the velocity rises"));
}

TEST_F(LawFile, WithoutTheFile) {
  EXPECT_THROW((void)drag_law_named("file:" + path_), core::FileError);
  EXPECT_FALSE(drag_file("cello"));
}

// Mean sphericity of 1 and 2 mm, shares 0.5 each, 0.8 and 1: (500 + 250)/(500/0.8 + 250) = 0.857143, by hand.
TEST(DragOfShapes, IsThatOfTheSpeciesAndOfTheirMean) {
  core::Scene scene;
  scene.species.resize(2);
  scene.species[0].diameter = 1e-3;
  scene.species[1].diameter = 2e-3;
  scene.bed.volume_share = {0.5, 0.5};
  scene.effects = {{"drag", "wen_yu"}, {"shape", "haider_levenspiel"}};
  EXPECT_FALSE(drag_law_of(scene).shape) << "spheres";
  scene.species[0].sphericity = 0.8;
  const closures::DragLaw law = drag_law_of(scene);
  ASSERT_TRUE(law.shape);
  const auto by_law = [](double psi) { return closures::haider_levenspiel(psi)(50).f; };
  EXPECT_EQ(law.shape->species[0](1, 50), by_law(0.8) / by_law(1));
  EXPECT_EQ(law.shape->species[1](1, 50), 1);
  EXPECT_NEAR(law.shape->mean(1, 50), by_law(0.857143) / by_law(1), 1e-5);  // the digits above
  EXPECT_EQ(drag_name_of(scene), "wen_yu x haider_levenspiel");
  scene.effects.erase("shape");
  EXPECT_FALSE(drag_law_of(scene).shape) << "off";
  scene.effects["shape"] = "auto";
  EXPECT_EQ(shape_of(scene, scene.species[0])(0.5, 0), closures::ergun(0.8).creeping);
}

}  // namespace
}  // namespace polybed::relevance
