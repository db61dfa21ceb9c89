#include "core/output/output.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <limits>

#include "core/error.hpp"
#include "core/numerics/metric.hpp"
#include "core/output/files.hpp"
#include "core/output/rows.hpp"
#include "scenes/stored_steps.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::core {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Grid small_grid(int dimensions) {
  Grid grid;
  grid.dimensions = dimensions;
  grid.cells = {3, 4, dimensions == 3 ? 2 : 1};
  grid.spacing = {0.1, 0.2, 0.3};
  return grid;
}

/// A field that tells its cell: i + 10 j + 100 k, and not a number in the ghosts.
Field telling(const Grid& grid, double offset = 0) {
  Field field = make_field(grid, nan);
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) field[std::size_t(grid.index(i, j, k))] = offset + i + 10 * j + 100 * k;
  return field;
}

const std::vector<FieldName> two_names{{"voidage", false}, {"u_fluid", true}};

void write_sample(FieldWriter& writer, const Grid& grid, double time) {
  std::vector<Field> parts;
  for (int n = 0; n <= grid.dimensions; ++n) parts.push_back(telling(grid, 1000 * n + time));
  std::vector<FieldValues> values{{parts[0]}, {}};
  for (int n = 1; n <= grid.dimensions; ++n) values[1].emplace_back(parts[std::size_t(n)]);
  writer.write_step(time, values);
}

TEST(Fields, OwnedCellsComeBackInCOrder) {
  for (int dimensions : {2, 3}) {
    const test::Scratch scratch;
    const Grid grid = small_grid(dimensions);
    FieldWriter writer(scratch.path(), grid, two_names);
    write_sample(writer, grid, 0.5);
    const FieldReader reader(scratch.path());
    EXPECT_THAT(reader.times(), ElementsAre(0.5));
    EXPECT_EQ(reader.index().read("grid/y").values.size(), 5u);
    EXPECT_DOUBLE_EQ(reader.index().read("grid/y").values.back(), 0.8);
    const DataSet scalar = reader.field(0, "voidage"), vector = reader.field(0, "u_fluid");
    if (dimensions == 2) {
      EXPECT_THAT(scalar.shape, ElementsAre(4, 3));
      EXPECT_THAT(vector.shape, ElementsAre(4, 3, 2));
      EXPECT_EQ(scalar.values[3 * 2 + 1], 0.5 + 1 + 20);
      EXPECT_EQ(vector.values[2 * (3 * 2 + 1) + 1], 2000.5 + 1 + 20);
    } else {
      EXPECT_THAT(scalar.shape, ElementsAre(2, 4, 3));
      EXPECT_THAT(vector.shape, ElementsAre(2, 4, 3, 3));
      EXPECT_EQ(scalar.values[3 * (4 + 2) + 1], 0.5 + 1 + 20 + 100);
      EXPECT_EQ(vector.values[3 * (3 * (4 + 2) + 1) + 2], 3000.5 + 1 + 20 + 100);
    }
  }
}

// Corners of a tube of four by four cells lie beyond its wall: ParaView is given what is open, in the order of fields.
TEST(Fields, OfATubeTellWhatIsOpen) {
  const test::Scratch scratch;
  Grid grid = small_grid(3);
  grid.cells = {4, 3, 4};
  grid.spacing = {0.1, 0.2, 0.1};
  grid.metric = metric_of(grid, ColumnShape::cylinder);
  FieldWriter writer(scratch.path(), grid, two_names);
  write_sample(writer, grid, 0.5);
  const DataSet open = FieldReader(scratch.path()).index().read("grid/open");
  EXPECT_THAT(open.shape, ElementsAre(4, 3, 4));
  EXPECT_EQ(open.values[0], 0);
  EXPECT_EQ(open.values[4 * (1 + 3 * 2) + 1], grid.metric->volume[std::size_t(grid.index(1, 1, 2))]);
  EXPECT_GT(open.values[4 * (1 + 3 * 2) + 1], 0);
  EXPECT_THAT(read_text(scratch.path() / "fields.xdmf"), HasSubstr("fields.h5:/grid/open"));
  FieldWriter resumed(scratch.path(), grid, two_names, 0.5);
  write_sample(resumed, grid, 1.0);
  EXPECT_THAT(FieldReader(scratch.path()).times(), ElementsAre(0.5, 1.0));
}

TEST(Fields, AreCompleteAfterEveryStep) {
  const test::Scratch scratch;
  const Grid grid = small_grid(2);
  FieldWriter writer(scratch.path(), grid, two_names);
  for (int n = 0; n < 3; ++n) {
    write_sample(writer, grid, n);
    const FieldReader reader(scratch.path());
    ASSERT_EQ(reader.times().size(), std::size_t(n) + 1);
    EXPECT_EQ(reader.field(std::size_t(n), "voidage").values[0], n);
    EXPECT_THAT(read_text(scratch.path() / "fields.xdmf"), HasSubstr("<Time Value=\"" + std::to_string(n)));
  }
  EXPECT_THAT(FieldReader(scratch.path()).names(2), ElementsAre("u_fluid", "voidage"));
}

TEST(Fields, AStepWithoutItsIndexIsNotSeenAndIsReplaced) {
  const test::Scratch scratch;
  const Grid grid = small_grid(2);
  {
    FieldWriter writer(scratch.path(), grid, two_names);
    write_sample(writer, grid, 0);
  }
  write_atomically(scratch.path() / "fields/000002.h5", "what a killed run leaves");
  EXPECT_EQ(FieldReader(scratch.path()).times().size(), 1u);
  FieldWriter writer(scratch.path(), grid, two_names, 0.0);
  write_sample(writer, grid, 1);
  EXPECT_EQ(FieldReader(scratch.path()).field(1, "voidage").values[0], 1);
}

TEST(Fields, ResumingRemovesLaterSteps) {
  const test::Scratch scratch;
  const Grid grid = small_grid(2);
  {
    FieldWriter writer(scratch.path(), grid, two_names);
    for (int n = 0; n < 4; ++n) write_sample(writer, grid, n);
  }
  FieldWriter writer(scratch.path(), grid, two_names, 1.0);
  EXPECT_THAT(FieldReader(scratch.path()).times(), ElementsAre(0, 1));
  EXPECT_FALSE(fs::exists(scratch.path() / "fields/000003.h5"));
  write_sample(writer, grid, 7);
  const FieldReader reader(scratch.path());
  EXPECT_THAT(reader.times(), ElementsAre(0, 1, 7));
  EXPECT_EQ(reader.field(2, "voidage").values[0], 7);
  Grid other = grid;
  other.cells[0] = 5;
  EXPECT_THROW(FieldWriter(scratch.path(), other, two_names, 1.0), FileError);
}

TEST(Fields, ANewRunRemovesTheOldSteps) {
  const test::Scratch scratch;
  const Grid grid = small_grid(2);
  {
    FieldWriter writer(scratch.path(), grid, two_names);
    write_sample(writer, grid, 0);
  }
  const FieldWriter writer(scratch.path(), grid, two_names);
  EXPECT_TRUE(FieldReader(scratch.path()).times().empty());
  EXPECT_FALSE(fs::exists(scratch.path() / "fields/000001.h5"));
  EXPECT_FALSE(fs::exists(scratch.path() / "fields.xdmf"));
}

TEST(Fields, NoNotANumberReachesTheDisk) {
  const test::Scratch scratch;
  const Grid grid = small_grid(2);
  FieldWriter writer(scratch.path(), grid, {{"voidage", false}});
  Field field = telling(grid);
  field[std::size_t(grid.index(1, 2))] = nan;
  const std::vector<FieldValues> values{{field}};
  try {
    writer.write_step(0.25, values);
    FAIL() << "a NaN was written";
  } catch (const NumericsError& error) {
    EXPECT_THAT(error.what(), HasSubstr("voidage"));
    EXPECT_THAT(error.what(), HasSubstr("(1, 2, 0)"));
  }
  EXPECT_TRUE(FieldReader(scratch.path()).times().empty());
  EXPECT_FALSE(fs::exists(scratch.path() / "fields/000001.h5"));
}

TEST(Fields, AFullDiskLeavesTheStepsBefore) {
  const test::Scratch scratch;
  const Grid grid = small_grid(2);
  FieldWriter writer(scratch.path(), grid, two_names);
  write_sample(writer, grid, 0);
  {
    const test::FullDisk disk(2000);
    EXPECT_THROW(write_sample(writer, grid, 1), FileError);
  }
  const FieldReader reader(scratch.path());
  EXPECT_EQ(reader.times().size(), 1u);
  EXPECT_EQ(reader.field(0, "voidage").values[0], 0);
}

TEST(Fields, CellMeansJoinPeriodicSides) {
  Grid grid = small_grid(2);
  grid.periodic[0] = true;
  FaceField faces = make_face_field(grid, nan);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) faces[0][std::size_t(grid.index(i, j))] = i;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= 4; ++j) faces[1][std::size_t(grid.index(i, j))] = j;
  const FaceField means = cell_means(grid, faces);
  EXPECT_EQ(means[0][std::size_t(grid.index(0, 1))], 0.5);
  EXPECT_EQ(means[0][std::size_t(grid.index(2, 1))], 1.0);
  EXPECT_EQ(means[1][std::size_t(grid.index(2, 3))], 3.5);
}

TEST(OutputFile, UnknownKindOrVersionIsRefused) {
  const test::Scratch scratch;
  const fs::path path = scratch.path() / "a.h5";
  OutputFile({"polybed fields", 2}).save(path);
  EXPECT_NO_THROW(OutputFile(path, {"polybed fields", 2}));
  EXPECT_THROW(OutputFile(path, {"polybed fields", 1}), FileError);
  EXPECT_THROW(OutputFile(path, {"polybed profiles", 2}), FileError);
  write_atomically(path, "no HDF5");
  EXPECT_THROW(OutputFile(path, {"polybed fields", 2}), FileError);
}

TEST(Profiles, ComeBackAndResume) {
  const test::Scratch scratch;
  const std::vector<double> height{0.5, 1.5};
  const std::vector<std::string> names{"phi_fine", "p"};
  {
    ProfileWriter writer(scratch.path(), height, names);
    for (int n = 0; n < 20; ++n) {
      const std::vector<std::vector<double>> rows{{0.1 * n, 0.2 * n}, {10.0 * n, 20.0 * n}};
      writer.write_row(n, rows);
      ASSERT_EQ(read_profiles(scratch.path()).time.size(), std::size_t(n) + 1);
    }
    const std::vector<std::vector<double>> bad{{0.1, nan}, {1, 2}};
    EXPECT_THROW(writer.write_row(20, bad), NumericsError);
  }
  ProfileWriter writer(scratch.path(), height, names, 17.5);
  const Profiles back = read_profiles(scratch.path());
  EXPECT_EQ(back.time.size(), 18u);
  EXPECT_EQ(back.height, height);
  EXPECT_THAT(back.of("p").shape, ElementsAre(18, 2));
  EXPECT_EQ(back.of("p").values.back(), 340);
  EXPECT_THROW((void)back.of("phi_none"), FileError);
  EXPECT_THROW(ProfileWriter(scratch.path(), {0.5}, names, 1.0), FileError);
}

TEST(Profiles, ThatAreNoNumbersAreADamagedFile) {
  const test::Scratch scratch;
  const std::vector<std::vector<double>> rows{{0.1, 0.2}};
  ProfileWriter(scratch.path(), {0.5, nan}, {"phi_fine"}).write_row(0, rows);
  EXPECT_THROW(read_profiles(scratch.path()), FileError);
}

/// A directory in the place of the temporary file stands for a disk without room for a second file.
TEST(Files, TheLastContentIsWrittenInPlaceWhereItCannotBeReplaced) {
  const test::Scratch scratch;
  const fs::path path = scratch.path() / "run.json", other = scratch.path() / "other";
  write_last(path, "a long record of a run that goes on");
  fs::create_directories(path.string() + ".temporary/full");
  EXPECT_THROW(write_atomically(path, "done"), FileError);
  write_last(path, "done");
  EXPECT_EQ(read_text(path), "done");
  fs::create_hard_link(path, other);  // of a user's file
  EXPECT_THROW(write_last(path, "more"), FileError);
  fs::remove(path);
  fs::create_symlink(other, path);
  EXPECT_THROW(write_last(path, "more"), FileError);
  EXPECT_EQ(read_text(other), "done");
}

TEST(History, ReadsBackToTheBitAndResumes) {
  const test::Scratch scratch;
  const std::vector<std::string> columns{"time_s", "interface_m"};
  const double third = 1.0 / 3;
  {
    HistoryWriter writer(scratch.path(), columns);
    for (double t : {0.1, 0.2, 0.1 + 0.2}) {
      const std::vector<std::optional<double>> row{t, t > 0.15 ? std::optional(third) : std::nullopt};
      writer.write_row(row);
    }
    EXPECT_EQ(read_history(scratch.path()).of("time_s").size(), 3u);
    const std::vector<std::optional<double>> bad{0.4, nan};
    EXPECT_THROW(writer.write_row(bad), NumericsError);
  }
  EXPECT_EQ(read_text(scratch.path() / "history.csv"),
            "time_s,interface_m\n0.1,\n0.2,0.3333333333333333\n0.30000000000000004,0.3333333333333333\n");
  std::string cut = read_text(scratch.path() / "history.csv");
  cut += "0.35,0.3";
  write_atomically(scratch.path() / "history.csv", cut);
  const History history = read_history(scratch.path());
  for (const char* row : {"0.31,inf\n", "0.31\n", "0.31,0.3x\n"}) {
    write_atomically(scratch.path() / "history.csv", cut + "\n" + row);
    EXPECT_THROW((void)read_history(scratch.path()), FileError) << row;
  }
  write_atomically(scratch.path() / "history.csv", cut);
  EXPECT_EQ(history.of("time_s").back(), 0.1 + 0.2);
  EXPECT_EQ(history.of("interface_m").back(), third);
  { const HistoryWriter writer(scratch.path(), columns, 0.2); }
  EXPECT_THAT(read_history(scratch.path()).of("time_s"), ElementsAre(0.1, 0.2));
  EXPECT_THROW(HistoryWriter(scratch.path(), {"time_s"}, 0.2), FileError);
}

/// What a table of rows keeps of a text up to 0.25 s, or why it is refused.
std::string kept_of(const std::string& text) {
  const test::Scratch scratch;
  write_atomically(scratch.path() / "steps.csv", text);
  try {
    return kept_rows(scratch.path() / "steps.csv", "time_s,dt_s,limited_by\n", 0.25);
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(Rows, CountOnlyWhole) {
  const std::string header = "time_s,dt_s,limited_by\n", rows = header + "0.1,0.1,\"drag at (0, 1)\"\n0.2,,\"\"\n";
  EXPECT_EQ(kept_of(rows + "0.3,0.1,\"growth\"\n"), rows);
  EXPECT_EQ(kept_of(rows + "0.2"), rows);  // 0.25 cut short
  EXPECT_EQ(kept_of(rows + "0.21,0.1,\"gro"), rows);
  EXPECT_EQ(kept_of("time"), header);
  EXPECT_THAT(kept_of("time_s\n"), HasSubstr("has other columns"));
  for (const char* row : {"0.2", "inf,0.1,\"a\"", "nan,0.1,\"a\"", "0.2,1e999,\"a\"", "0.2,0.1,\"a", "0.2,0.1,a",
                          ",0.1,\"a\"", "0.2,0.1,\"a\",1", "0.2x,0.1,\"a\"", "1e,0.1,\"a\"", ""})
    EXPECT_THAT(kept_of(rows + row + "\n0.24,0.1,\"a\"\n"), HasSubstr("steps.csv:4: ")) << row;
}

TEST(Rows, CarryAChecksum) {
  const std::string row = "a1b2,12,1.5,10.3249", sealed = with_check(row);
  EXPECT_EQ(without_check(sealed), row);
  EXPECT_EQ(without_check(row), std::nullopt);
  for (std::size_t n = 0; n < sealed.size(); ++n) {
    EXPECT_EQ(without_check(sealed.substr(0, n)), std::nullopt) << n;
    std::string other = sealed;
    other[n] ^= 1;
    EXPECT_EQ(without_check(other), std::nullopt) << n;
  }
}

/// Writes files in memory until that ends, with some bytes more of it than this process has, and ends with code 0.
[[noreturn]] void write_without_memory(rlim_t more) {
  std::ifstream status("/proc/self/statm");
  rlim_t pages = 0;
  status >> pages;
  const rlimit limit{pages * rlim_t(sysconf(_SC_PAGESIZE)) + more, RLIM_INFINITY};
  setrlimit(RLIMIT_AS, &limit);
  const std::vector<double> values(10'000, 1.0);
  try {
    for (std::vector<OutputFile> files;;) {
      files.emplace_back(FileKind{"polybed test", 1}).write("values", {values.size()}, values, Packing::small);
    }
  } catch (const FileError&) {
  } catch (const std::bad_alloc&) {
  }
  std::exit(0);
}

/// HDF5 alone prints as the program ends ("infinite loop closing library"), or crashes where it makes a file.
TEST(Output, HdfNeitherPrintsNorCrashesWithoutMemory) {
  for (rlim_t more = 500'000; more < 20'000'000; more += 500'000)
    EXPECT_EXIT(write_without_memory(more), testing::ExitedWithCode(0), testing::Eq("")) << more << " bytes";
}

}  // namespace
}  // namespace polybed::core
