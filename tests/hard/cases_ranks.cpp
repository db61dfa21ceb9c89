// Hard cases of several ranks and of runs taken up again: P1 to P10, all but P9 by this program as its user starts it.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"
#include "core/numerics/random.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "hard/cases.hpp"
#include "hard/program.hpp"
#include "hard/textbook.hpp"
#include "scenes/beads.hpp"
#include "scenes/scratch.hpp"

namespace polybed::hard {

namespace {

namespace fs = std::filesystem;

/// Spheres with friction in a box joined on all sides; a line of it for each: x, y, z, vx, vy, vz.
struct Box {
  double width = 12e-3, height = 6e-3;
  std::vector<std::array<double, 6>> spheres;
  std::string more = {};  ///< lines of [dem]
};

fs::path write_case(const fs::path& folder, const Box& box) {
  std::ofstream list(folder / "list.csv");
  list << "species,x,y,z,vx,vy,vz\n";
  for (const auto& s : box.spheres) list << fmt::format("a,{:.17g}\n", fmt::join(s, ","));
  std::ofstream file(folder / "case.toml");
  file << fmt::format(
      "[column]\nsize = [{0}, {1}, {1}]\ncells = [4, 2, 2]\nsides = \"periodic\"\nends = \"periodic\"\ngravity = 0\n"
      "[fluid]\nname = \"none\"\n[[species]]\nname = \"a\"\ndiameter = 1e-3\ndensity = 2500\n"
      "[bed]\nstart = \"list:list.csv\"\n[effects]\ncontact = \"hertz_mindlin\"\n"
      "[dem]\nyoungs_modulus = 5e7\nfriction = 0.5\ngreatest_speed = 3\nskin = 1e-4\n{2}\n[run]\nuntil = 0.02\n"
      "[output]\nevery = 0.02\nhistory_every = 0.02\ncheckpoint_every = 0.01\n",
      box.width, box.height, box.more);
  return folder / "case.toml";
}

std::vector<std::string> dem(const fs::path& file, const fs::path& output, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"dem", file.string(), "-o", output.string(), "--quiet", "--no-picture"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The state of the particles at the end of a run, which must have ended well. What counts work, and how ranks met, is
/// left out.
core::Checkpoint end_of(Trial& trial, int ranks, const std::vector<std::string>& words, const fs::path& output) {
  const ProgramEnd end = run_program(ranks, words);
  trial.measure("V16 code of the run", end.code, 0);
  if (end.code != 0) throw core::NumericsError(end.said);
  return core::read_checkpoint(output / "checkpoint.h5");
}

double bits_apart(const core::Checkpoint& a, const core::Checkpoint& b) {
  double apart = a.arrays.size() == b.arrays.size() ? 0 : 1;
  for (const auto& [name, values] : a.arrays) {
    const auto other = b.arrays.find(name);
    if (other == b.arrays.end() || other->second != values) apart += 1;
  }
  return apart;
}

/// The same bits on each number of ranks as on one.
void same_on(Trial& trial, const Box& box, const std::vector<int>& numbers) {
  const scenes::Scratch folder;
  const fs::path file = write_case(folder.path(), box);
  const core::Checkpoint alone = end_of(trial, 1, dem(file, folder.path() / "1"), folder.path() / "1");
  for (const int ranks : numbers) {
    const fs::path output = folder.path() / std::to_string(ranks);
    trial.measure("V9 arrays that differ", bits_apart(alone, end_of(trial, ranks, dem(file, output), output)), 0);
  }
}

std::vector<std::array<double, 6>> lattice(double from, double to, double speed) {
  std::vector<std::array<double, 6>> spheres;
  int n = 0;
  for (double x = from; x < to; x += 1.2e-3)
    for (const double y : {1e-3, 2.3e-3, 4e-3})
      for (const double z : {1e-3, 3e-3, 5e-3}) {
        const double sign = ++n % 2 == 0 ? 1 : -1;
        spheres.push_back({x, y, z, sign * speed, 0.3 * sign * speed, -0.2 * speed});
      }
  return spheres;
}

/// P1: all in the left third; P2: a single sphere; P3: fast ones that cross a rank in few steps.
void rank_without_particles(Trial& trial) { same_on(trial, {.spheres = lattice(0.6e-3, 4e-3, 0.2)}, {3}); }
void all_on_one_rank(Trial& trial) { same_on(trial, {.spheres = {{6e-3, 3e-3, 3e-3, 0.5, 0.1, 0}}}, {2}); }
void crossing_ranks(Trial& trial) { same_on(trial, {.spheres = lattice(0.6e-3, 11e-3, 0.9)}, {3}); }
/// P4: odd numbers.
void odd_numbers(Trial& trial) { same_on(trial, {.spheres = lattice(0.6e-3, 11e-3, 0.3)}, {5}); }

/// P5: slabs thinner than a sphere: the same bits, or refused with a reason.
void thin_slabs(Trial& trial) {
  const Box box{.width = 3e-3, .height = 3e-3, .spheres = {{1e-3, 1e-3, 1e-3, 0.2, 0, 0}}};
  const scenes::Scratch folder;
  const fs::path file = write_case(folder.path(), box), output = folder.path() / "out";
  const ProgramEnd end = run_program(7, dem(file, output));
  const bool told = end.said.find("rank") != std::string::npos;
  trial.measure("V16 runs, or is refused with a reason",
                end.code == 0 || (end.code == 2 && told) || (end.code == 5 && told) ? 0 : 1, 0);
  if (end.code != 0) throw core::CaseError(end.said);
  const fs::path one = folder.path() / "1";
  trial.measure("V9 arrays that differ",
                bits_apart(end_of(trial, 1, dem(file, one), one), core::read_checkpoint(output / "checkpoint.h5")), 0);
}

/// Steps in which two spheres of a box touched each other, on one rank.
double contact_steps(Trial& trial, const Box& box) {
  const scenes::Scratch folder;
  const fs::path output = folder.path() / "out";
  (void)end_of(trial, 1, dem(write_case(folder.path(), box), output), output);
  const core::Json record = core::read_json(output / "run.json");
  return core::number_of(core::member_of(core::member_of(record, "work"), "contact_steps"));
}

/// P6: two spheres roll on each other across the face of a slab, two more across a corner of the box; each pair has a
/// history of more than some steps.
void friction_across_faces(Trial& trial) {
  const std::vector<std::array<double, 6>> face{{5.51e-3, 3e-3, 3e-3, 0.05, 0.05, 0},
                                                {6.49e-3, 3e-3, 3e-3, -0.05, -0.05, 0}},
      corner{{0.35e-3, 0.35e-3, 0.3e-3, -0.05, 0.1, 0}, {11.75e-3, 5.75e-3, 5.8e-3, 0.05, 0, 0.1}};
  constexpr double some = 10;
  double missing = 0;
  for (const auto& pair : {face, corner}) missing += contact_steps(trial, {.spheres = pair}) > some ? 0 : 1;
  trial.measure("contacts missing", missing, 0);
  Box both{.spheres = face};
  both.spheres.insert(both.spheres.end(), corner.begin(), corner.end());
  same_on(trial, both, {2, 3});
}

/// P7: a run taken up on another number of ranks has the bits of the one that went through.
void other_numbers(Trial& trial) {
  const scenes::Scratch folder;
  const fs::path file = write_case(folder.path(), {.spheres = lattice(0.6e-3, 11e-3, 0.3)});
  const fs::path whole = folder.path() / "whole", parts = folder.path() / "parts";
  const core::Checkpoint through = end_of(trial, 1, dem(file, whole), whole);
  (void)end_of(trial, 2, dem(file, parts, {"--until", "0.01 s"}), parts);
  trial.measure("V10 arrays that differ", bits_apart(through, end_of(trial, 3, dem(file, parts, {"--resume"}), parts)),
                0);
}

/// The processes that one has started.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::string line;
    std::ifstream file(entry.path() / "stat");
    std::getline(file, line);
    const std::size_t name_end = line.rfind(')');  // "process (name) state parent ..."
    if (name_end == std::string::npos) continue;
    char state = 0;
    pid_t of = 0;
    std::istringstream(line.substr(name_end + 1)) >> state >> of;
    if (of == parent) found.push_back(std::stoi(entry.path().filename()));
  }
  return found;
}

/// P8: one rank of two is killed in mid-run: the last checkpoint is whole, and the run goes on from it.
void killed(Trial& trial) {
  const scenes::Scratch folder;
  const fs::path file = write_case(folder.path(), {.spheres = lattice(0.6e-3, 11e-3, 0.3)});
  const fs::path output = folder.path() / "out", whole = folder.path() / "whole";
  const std::vector<std::string> until{"--until", "0.1 s"};  // ten times as long as to the first checkpoint
  const core::Checkpoint through = end_of(trial, 1, dem(file, whole, until), whole);
  bool killed = false;
  const ProgramEnd end = run_program(2, dem(file, output, until), [&](const ChildProgram& mpirun) {
    if (killed || !fs::exists(output / "checkpoint.h5")) return;
    for (const pid_t rank : children_of(mpirun.process())) {
      killed = ::kill(rank, SIGKILL) == 0;
      if (killed) return;
    }
  });
  trial.measure("V16 ended by the kill", killed && end.code == 128 + SIGKILL ? 0 : 1, 0);
  trial.measure("V10 arrays that differ",
                bits_apart(through, end_of(trial, 1, dem(file, output, {"--resume", until[0], until[1]}), output)), 0);
}

/// P9: spheres pressed together are listed in another order, as those of other ranks would be: the same bits.
void order_of_sums(Trial& trial) {
  core::Scene scene = scenes::dry_box(0.5e-3, {5e6, 0.25, 2500}, {4e-3, 4e-3, 4e-3});
  scene.column.sides = scene.column.ends = core::Boundary::periodic;
  std::vector<scenes::Bead> beads;
  constexpr std::int64_t number = 125;
  for (std::uint64_t n = 0; n < number; ++n) {
    scenes::Bead bead{"a", {}};
    const std::array<std::uint64_t, 3> at{n % 5, n / 5 % 5, n / 25};
    for (std::size_t k = 0; k < 3; ++k) {
      bead.x[k] = (double(at[k]) + 0.45 + 0.1 * core::uniform(11, k, n)) * 0.8e-3;
      bead.v[k] = 0.1 * (core::uniform(12, k, n) - 0.5);
    }
    beads.push_back(bead);
  }
  const auto forces = [&](const std::vector<scenes::Bead>& list) {
    std::vector<dem::Vector> found;
    if (trial.naive()) {
      core::Scene stepped = scene;
      stepped.dem.fixed_step = 1e-6;
      const auto run = textbook::spheres(trial.treatment().naive, stepped, list);
      for (std::int64_t n = 0; n < number; ++n) found.push_back(run->force(n));
      return found;
    }
    scene.dem.max_overlap = 0.5;
    scenes::Beads run(scene, list);
    for (std::int64_t n = 0; n < number; ++n) found.push_back(run.force(n));
    return found;
  };
  const std::vector<dem::Vector> one = forces(beads);
  std::reverse(beads.begin(), beads.end());
  std::vector<dem::Vector> other = forces(beads);
  std::reverse(other.begin(), other.end());
  double apart = 0, greatest = 0;
  for (std::size_t n = 0; n < one.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) {
      apart = std::max(apart, std::abs(one[n][k] - other[n][k]));
      greatest = std::max(greatest, std::abs(one[n][k]));
    }
  trial.measure("V9 greatest difference of a force", apart / greatest, 0);
}

/// P10: two ranks tell each other of spheres at their common faces in a hundred thousand steps: the bits of one rank,
/// and no more memory than a tenth of the steps takes.
void many_messages(Trial& trial) {
  const scenes::Scratch folder;
  const fs::path file =
      write_case(folder.path(), {.spheres = lattice(0.6e-3, 11e-3, 0.3), .more = "fixed_step = 2e-7"});
  const auto memory_after = [&](const std::string& name, const std::string& until) {
    (void)end_of(trial, 2, dem(file, folder.path() / name, {"--until", until}), folder.path() / name);
    rusage use{};
    ::getrusage(RUSAGE_CHILDREN, &use);
    return double(use.ru_maxrss) * 1024;
  };
  const double few = memory_after("few", "0.002 s"), many = memory_after("many", "0.02 s");
  trial.measure("memory grown, MB", 1e-6 * (many - few), 2);  // what an allocator takes at once; a request leaked by
                                                              // each message would be ten times that
  const core::Checkpoint alone = end_of(trial, 1, dem(file, folder.path() / "1"), folder.path() / "1");
  trial.measure("V9 arrays that differ",
                bits_apart(alone, core::read_checkpoint(folder.path() / "many" / "checkpoint.h5")), 0);
}

}  // namespace

std::vector<HardCase> rank_cases() {
  const std::vector<Treatment> ranks{{"ranks", "", ""}};
  return {{"P1", "a rank without particles", {}, ranks, rank_without_particles},
          {"P2", "all particles on one rank", {}, ranks, all_on_one_rank},
          {"P3", "migration over ranks", {}, ranks, crossing_ranks},
          {"P4", "particles on five ranks", {}, ranks, odd_numbers},
          {"P5", "slabs thinner than a sphere", {}, ranks, thin_slabs},
          {"P6", "friction across a slab and a corner", {}, ranks, friction_across_faces},
          {"P7", "restarted on other numbers of ranks", {}, ranks, other_numbers, false},
          {"P8", "a rank killed in mid-run", {}, ranks, killed, false},
          {"P9", "sums that must not depend on their order", {"float_sums"}, ranks, order_of_sums},
          {"P10", "a hundred thousand steps of messages", {}, ranks, many_messages, false}};
}

}  // namespace polybed::hard
