#include "multiscale/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/numerics/mpi_start.hpp"

namespace polybed::multiscale {

namespace fs = std::filesystem;

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

fs::path beside_program(const fs::path& from_program, const fs::path& in_sources) {
  if (this_program().parent_path() == POLYBED_BUILD) return in_sources;  // what is beside the build is not ours
  std::error_code unknown;
  const fs::path installed = (this_program().parent_path() / from_program).lexically_normal();
  return fs::exists(installed, unknown) ? installed : in_sources;
}

std::vector<std::string> environment() {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) all.emplace_back(*entry);
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

std::string become(std::vector<std::string> words, std::vector<std::string> variables) {
  ::execve(words.front().c_str(), pointers_to(words).data(), pointers_to(variables).data());
  return std::system_category().message(errno);
}

namespace {

constexpr std::array<std::string_view, 5> settings{
    "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "OMPI_MCA_rmaps_base_oversubscribe=1",
    "OMPI_MCA_hwloc_base_binding_policy=none", "OMPI_MCA_btl_vader_single_copy_mechanism=none"};

void refuse_launcher(int ranks) {
  if (core::started_by_launcher())
    throw core::MpiError(fmt::format("-n {}: this is one of the ranks of a launcher already; leave out -n", ranks));
}

}  // namespace

fs::path mpirun() {
  if (::access(POLYBED_MPIRUN, X_OK) == 0) return POLYBED_MPIRUN;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "mpirun";
    if (program.is_absolute() && ::access(program.c_str(), X_OK) == 0) return program;
  }
  throw core::MpiError(fmt::format("mpirun is neither {} nor on PATH: install openmpi-bin", POLYBED_MPIRUN));
}

std::vector<std::string> environment_of_mpirun() {
  std::vector<std::string> all = environment();
  for (const std::string_view setting : settings) {
    const std::string_view name = setting.substr(0, setting.find('=') + 1);
    if (std::none_of(all.begin(), all.end(), [&](const std::string& entry) { return entry.starts_with(name); }))
      all.emplace_back(setting);
  }
  return all;
}

void keep_ranks_for_runs(int ranks) {
  if (ranks < 2) return;
  refuse_launcher(ranks);
  ::setenv("POLYBED_RANKS", std::to_string(ranks).c_str(), 1);
}

void become_ranks(int ranks, std::vector<std::string> words) {
  refuse_launcher(ranks);
  std::vector<std::string> all{mpirun(), "-q", "-n", std::to_string(ranks), this_program()};
  all.insert(all.end(), words.begin(), words.end());
  throw core::MpiError(fmt::format("cannot start {}: {}", all.front(), become(all, environment_of_mpirun())));
}

}  // namespace polybed::multiscale
