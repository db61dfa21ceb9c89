// Files that ranks write together, on as many as mpirun starts: the same numbers as from one rank, or one error for
// all.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "core/output/fields.hpp"
#include "scenes/stored_steps.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::core {
namespace {

namespace fs = std::filesystem;

const std::vector<FieldName> two_names{{"voidage", false}, {"u_fluid", true}};

/// A directory that all ranks know and the first one removes.
class SharedScratch {
 public:
  explicit SharedScratch(const Grid& block) : ranks_(block.ranks.get()) {
    if (is_first(block.ranks.get())) own_.emplace();
    path_ = said_by(block, 0, own_ ? own_->path().string() : "");
  }
  ~SharedScratch() {
    on_all(ranks_, [] {});  // nobody reads any more
  }
  SharedScratch(const SharedScratch&) = delete;
  SharedScratch& operator=(const SharedScratch&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  const Ranks* ranks_;
  std::optional<test::Scratch> own_;
  fs::path path_;
};

std::vector<Grid> columns() {
  std::vector<Grid> list;
  for (const int dimensions : {2, 3})
    for (const bool joined : {false, true}) {
      Grid grid;
      grid.dimensions = dimensions;
      grid.cells = {13, 23, dimensions == 3 ? 9 : 1};
      grid.spacing = {0.5, 0.25, 1};
      grid.periodic = {joined, false, false};
      list.push_back(grid);
    }
  return list;
}

/// A number with a full mantissa for each cell of the column; not a number in the ghosts.
Field telling(const Grid& grid, double kind) {
  Field field = make_field(grid, std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i)
        field[std::size_t(grid.index(i, j, k))] =
            std::sin(kind + i + grid.before[0] + 100.0 * (j + grid.before[1]) + 10000.0 * (k + grid.before[2]));
  return field;
}

/// Two steps of a run directory. \param odd  put in place of the velocity in the grid's last cell at the second time
void write_run(const fs::path& directory, const Grid& grid, std::optional<double> odd = {}) {
  FieldWriter writer(directory, grid, two_names);
  for (const double time : {0.0, 1.0}) {
    std::vector<Field> parts;
    for (int n = 0; n <= grid.dimensions; ++n) parts.push_back(telling(grid, n + 7 * time));
    if (time > 0 && odd)
      parts[1][std::size_t(grid.index(grid.cells[0] - 1, grid.cells[1] - 1, grid.cells[2] - 1))] = *odd;
    std::vector<FieldValues> values{{parts[0]}, {}};
    for (int n = 1; n <= grid.dimensions; ++n) values[1].emplace_back(parts[std::size_t(n)]);
    writer.write_step(time, values);
    EXPECT_EQ(writer.times().back(), time);
  }
}

void expect_same_bits(const DataSet& one, const DataSet& other) {
  EXPECT_EQ(one.shape, other.shape);
  ASSERT_EQ(one.values.size(), other.values.size());
  EXPECT_EQ(std::memcmp(one.values.data(), other.values.data(), one.values.size() * sizeof(double)), 0);
}

TEST(FieldFiles, AreWhatOneRankWrites) {
  for (const Grid& whole : columns()) {
    const Grid block = block_of(whole, Ranks::of_program());
    const SharedScratch scratch(block);
    const fs::path together = scratch.path() / "together", alone = scratch.path() / "alone";
    write_run(together, block);
    if (!is_first(block.ranks.get())) continue;
    write_run(alone, whole);
    const FieldReader one(alone), other(together);
    EXPECT_EQ(one.times(), other.times());
    for (std::size_t step = 0; step < 2; ++step) {
      EXPECT_EQ(one.names(step), other.names(step));
      for (const std::string& name : one.names(step)) expect_same_bits(one.field(step, name), other.field(step, name));
      if (whole.dimensions == 3) continue;
      const std::string file = "fields/" + std::string(step == 0 ? "000001.h5" : "000002.h5");
      const FileKind kind{"polybed fields step", 1};
      expect_same_bits(OutputFile(alone / file, kind).read("paraview/u_fluid"),
                       OutputFile(together / file, kind).read("paraview/u_fluid"));
    }
    EXPECT_EQ(read_whole_file(alone / "fields.xdmf"), read_whole_file(together / "fields.xdmf"));
    EXPECT_EQ(std::distance(fs::directory_iterator(together / "fields"), fs::directory_iterator()), 2);
  }
}

TEST(FieldFiles, NoNotANumberOfAnyRankReachesTheDisk) {
  const Grid block = block_of(columns()[0], Ranks::of_program());
  const SharedScratch scratch(block);
  const int last = block.ranks ? block.ranks->count() - 1 : 0;
  const bool mine = !block.ranks || block.ranks->rank() == last;
  try {
    write_run(scratch.path(), block, mine ? std::optional(std::numeric_limits<double>::infinity()) : std::nullopt);
    FAIL() << "written";
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("u_fluid (component 0) is inf in cell (12, 22, 0) at t = 1 s"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(FieldReader(scratch.path()).times().size(), 1u);
}

/// A state of a fraction and of the faces of an axis, one number for all, and a count of the first rank.
Checkpoint sample(const Grid& grid, double kind) {
  Checkpoint c;
  c.arrays["initial_mass"] = {0.1, kind};
  c.numbers["time_s"] = 0.1 + 0.2;
  c.integers["steps"] = is_first(grid.ranks.get()) ? 17 : 0;
  c.texts["case"] = is_first(grid.ranks.get()) ? "title = \"a bed\"" : "";
  const Field field = telling(grid, kind);
  for (int axis = -1; axis < 1; ++axis) {
    const Box box = axis < 0 ? owned_cells(grid) : owned_faces(grid, axis);
    CheckpointPart part{axis < 0 ? "phi" : "flux", {}};
    for (int a = grid.dimensions - 1; a >= 0; --a) {
      const auto d = std::size_t(a);
      part.slab.shape.push_back(std::size_t(grid.column_cells(a) + (a == axis && !grid.periodic[d] ? 1 : 0)));
      part.slab.start.push_back(std::size_t(grid.before[d]));
      part.slab.count.push_back(std::size_t(box.hi[d] - box.lo[d]));
    }
    for_each_row(grid, box, [&](Index b, Index e) {
      for (Index at = b; at < e; ++at)  // faces at a column's end have ghosts' places: any number will do
        c.arrays["state"].push_back(std::isnan(field[std::size_t(at)]) ? kind : field[std::size_t(at)]);
    });
    c.parts["state"].push_back(part);
  }
  return c;
}

TEST(CheckpointFiles, AreWhatOneRankWritesAndAnyNumberReads) {
  for (const Grid& whole : columns()) {
    const Grid block = block_of(whole, Ranks::of_program());
    const SharedScratch scratch(block);
    const fs::path together = scratch.path() / "checkpoint.h5", alone = scratch.path() / "alone.h5";
    for (const double kind : {1.0, 2.0}) write_checkpoint(together, sample(block, kind), block.ranks.get());
    const Checkpoint want = sample(block, 2), want_whole = sample(whole, 2);
    if (is_first(block.ranks.get())) {
      Checkpoint back = read_checkpoint(together);
      EXPECT_EQ(back.integers.at("steps"), 17);
      read_parts(together, want_whole.parts, back);
      EXPECT_EQ(back, want_whole);
      write_checkpoint(alone, want_whole);
      back = read_checkpoint(previous_checkpoint(together));
      read_parts(previous_checkpoint(together), want_whole.parts, back);
      EXPECT_EQ(back, sample(whole, 1));
    }
    on_all(block.ranks.get(), [] {});  // alone.h5 is there
    for (const fs::path& path : {together, alone}) {
      Checkpoint back;
      read_parts(path, want.parts, back);
      EXPECT_EQ(back.arrays.at("state"), want.arrays.at("state"));
    }
    CheckpointParts other = want.parts;
    ++other.at("state")[0].slab.shape[0];
    Checkpoint back;
    EXPECT_THROW(read_parts(together, other, back), FileError);
  }
}

/// Writes on a disk that is full for some ranks; whether that has failed, of which all must say the same.
bool fails_on_full_disk(const fs::path& path, const Grid& grid, const Checkpoint& checkpoint, bool full_here) {
  std::optional<test::FullDisk> disk;
  if (full_here) disk.emplace(20000);
  bool failed = false;
  try {
    write_checkpoint(path, checkpoint, grid.ranks.get());
  } catch (const FileError&) {
    failed = true;
  }
  EXPECT_EQ(on_any_rank(grid.ranks.get(), failed), failed);
  return failed;
}

/// MPI lets some of the ranks write for the others, so that one rank alone may well not meet the end of its disk.
TEST(CheckpointFiles, AFullDiskIsOneErrorAndLeavesTheOldOne) {
  const Grid block = block_of(columns()[3], Ranks::of_program());
  const SharedScratch scratch(block);
  const fs::path path = scratch.path() / "checkpoint.h5";
  const int ranks = block.ranks ? block.ranks->count() : 1, here = block.ranks ? block.ranks->rank() : 0;
  const Checkpoint first = sample(block, 1), second = sample(block, 2);
  for (int full = -1; full < ranks; ++full) {  // -1: for all
    write_checkpoint(path, first, block.ranks.get());
    const bool failed = fails_on_full_disk(path, block, second, full < 0 || full == here);
    EXPECT_TRUE(failed || full > 0) << "the first rank claims room for all";
    Checkpoint back;
    EXPECT_NO_THROW((void)read_checkpoint(path));
    read_parts(path, first.parts, back);
    EXPECT_EQ(back.arrays.at("state"), (failed ? first : second).arrays.at("state"));
    EXPECT_FALSE(fs::exists(path.string() + ".new"));
    EXPECT_FALSE(fs::exists(path.string() + ".new.temporary"));
    on_all(block.ranks.get(), [] {});  // before the next one is written
  }
}

}  // namespace
}  // namespace polybed::core
