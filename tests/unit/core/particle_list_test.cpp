#include "core/case/particle_list.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::core {
namespace {

using testing::HasSubstr;

/// A column of 0.06 x 0.6 x 0.004 m with two species, and a list of particles for it.
class ListOfParticles : public testing::Test {
 protected:
  ListOfParticles() {
    scene_.species.resize(2);
    scene_.species[0].name = "fine";
    scene_.species[1].name = "coarse";
    scene_.column.size = {0.06, 0.6, 0.004};
    scene_.bed.start = {core::StartKind::list, file().string()};
  }
  [[nodiscard]] std::filesystem::path file() const { return scratch_.path() / "beads.csv"; }
  ParticleList read(const std::string& text) {
    std::ofstream(file(), std::ios::binary) << text;
    return read_particle_list(scene_);
  }
  /// What is wrong with a list, the file's name as F.
  std::string message_of(const std::string& text) {
    try {
      (void)read(text);
    } catch (const CaseError& error) {
      std::string message = error.what();
      for (std::size_t at; (at = message.find(file().string())) != std::string::npos;)
        message.replace(at, file().string().size(), "F");
      return message;
    }
    return "";
  }
  test::Scratch scratch_;
  Scene scene_;
};

TEST_F(ListOfParticles, IsReadWithColumnsInAnyOrder) {
  const ParticleList list = read(
      "\xef\xbb\xbfx, y ,z,species,wz,vx\r\n"
      "0.01,0.02,0.003,coarse,-7,0.5\r\n"
      "\r\n"
      " 1e-3, .5, 0, fine,0,-1e-2\r\n");
  EXPECT_THAT(list.species, testing::ElementsAre(1, 0));
  EXPECT_THAT(list.position[0], testing::ElementsAre(0.01, 0.02, 0.003));
  EXPECT_THAT(list.velocity[0], testing::ElementsAre(0.5, 0, 0));
  EXPECT_THAT(list.spin[0], testing::ElementsAre(0, 0, -7));
  EXPECT_THAT(list.position[1], testing::ElementsAre(1e-3, 0.5, 0));
  EXPECT_THAT(list.velocity[1], testing::ElementsAre(-0.01, 0, 0));
}

TEST_F(ListOfParticles, LiesWithinARoundColumn) {
  scene_.column.size = {0.06, 0.6, 0.06};
  scene_.column.shape = ColumnShape::cylinder;
  EXPECT_EQ(read("species,x,y,z\nfine,0.012,0.1,0.053\n").species.size(), 1U);  // 18 and 23 mm from the axis
  EXPECT_THAT(message_of("species,x,y,z\nfine,0.012,0.1,0.055\n"),
              HasSubstr("F:2:6: x = 0.012 m, z = 0.055 m: the centre lies outside the round column, 0.0308058 m from "
                        "its axis, whose radius is 0.03 m"));
}

TEST_F(ListOfParticles, TellsAllThatIsWrongWithLineColumnAndSuggestion) {
  const std::string message = message_of(
      "species,x,y,z,vx\n"
      "fin,0.01,0.1,0,0\n"
      "fine,0.01,0.1,0\n"
      "fine,0.07,0.1,-1,0\n"
      "fine,0.01,nan,0,1e999\n"
      "fine,0.01,0.1 m,0,\n"
      "coarse,0.01,0.1,0.001,0\n"
      ",0.01,0.1,0.001,0\n");
  for (const char* expected :
       {"F:2:1: no species 'fin': there are fine, coarse; did you mean 'fine'?",
        "F:3:1: 4 values, the header names 5 columns",
        "F:4:6: x = 0.07 m: the centre lies outside the column, 0 to 0.06 m",
        "F:4:6: z = -1 m: the centre lies outside the column, 0 to 0.004 m",
        "F:5:11: y = nan is out of range: finite numbers", "F:5:17: vx = 1e999 is out of range: finite numbers",
        "F:6:11: y = '0.1 m': expected a number in SI units", "F:6:19: vx = '': expected a number in SI units",
        "F:8:1: no species ''"})
    EXPECT_THAT(message, HasSubstr(expected));
  EXPECT_THAT(message, Not(HasSubstr("F:7")));
}

TEST_F(ListOfParticles, NeedsItsHeader) {
  EXPECT_THAT(message_of("species,x,y\nfine,0,0\n"), HasSubstr("F:1:1: column 'z' is missing"));
  EXPECT_THAT(message_of("species,x,y,z,x\n"), HasSubstr("F:1:15: column 'x' stands twice"));
  EXPECT_THAT(message_of("specis,x,y,z\n"),
              HasSubstr("F:1:1: unknown column 'specis': allowed are species, x, y, z, vx, vy, vz, wx, wy, wz; did you "
                        "mean 'species'?"));
  EXPECT_THAT(message_of("fine,0.01,0.1,0\n"), HasSubstr("F:1:1: column 'species' is missing"));
  EXPECT_THAT(message_of(""), HasSubstr("F: no particles"));
  EXPECT_THAT(message_of("species,x,y,z\n"), HasSubstr("F: no particles"));
}

TEST_F(ListOfParticles, TellsAHundredProblemsAndTheNumberOfTheRest) {
  std::string text = "species,x,y,z\n";
  for (int n = 0; n < 250; ++n) text += "fine,-1,0,0\n";
  const std::string message = message_of(text);
  EXPECT_THAT(message, HasSubstr("F:101:6: "));
  EXPECT_THAT(message, Not(HasSubstr("F:102:6: ")));
  EXPECT_THAT(message, HasSubstr("150 more problems like these"));
}

TEST_F(ListOfParticles, ThatCannotBeReadSaysWhy) {
  EXPECT_THAT([&] { (void)read_particle_list(scene_); },
              testing::ThrowsMessage<FileError>(HasSubstr("beads.csv: No such file")));
  scene_.bed.start = {core::StartKind::mixed};
  EXPECT_THROW((void)read_particle_list(scene_), CaseError);
}

}  // namespace
}  // namespace polybed::core
