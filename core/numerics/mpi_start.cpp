#include "core/numerics/mpi_start.hpp"

#include <sched.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/numerics/mpi.hpp"

namespace polybed::core {

namespace {

/// Environment variables of this process while it lives. Open MPI reads its settings when it starts, and child
/// processes must not inherit them. A variable set by the user stays.
class Settings {
 public:
  void set(const char* name, const char* value) {
    if (std::getenv(name) != nullptr || ::setenv(name, value, 1) != 0) return;
    names_.emplace_back(name);
  }
  Settings() = default;
  Settings(const Settings&) = delete;
  Settings& operator=(const Settings&) = delete;
  ~Settings() {
    for (const std::string& name : names_) ::unsetenv(name.c_str());
  }

 private:
  std::vector<std::string> names_;
};

/// Whether the ranks on this machine outnumber the cores that they can use.
bool oversubscribed() {
  const char* ranks = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  cpu_set_t cores;
  return ranks != nullptr && ::sched_getaffinity(0, sizeof(cores), &cores) == 0 && std::atoi(ranks) > CPU_COUNT(&cores);
}

}  // namespace

void check_mpi(int code, const char* call) {
  if (code != MPI_SUCCESS) throw MpiError(std::string(call) + " failed");
}

bool started_by_launcher() {
  constexpr std::array names{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"};
  return std::any_of(names.begin(), names.end(), [](const char* name) { return std::getenv(name) != nullptr; });
}

bool first_by_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* rank = std::getenv(name)) return std::atoi(rank) == 0;
  return true;
}

void open_mpi() {
  int started = 0;
  MPI_Initialized(&started);
  if (started != 0) return;
  Settings settings;
  if (!started_by_launcher()) {
    settings.set("OMPI_MCA_ess_singleton_isolated", "1");
    settings.set("OMPI_MCA_orte_create_session_dirs", "0");
    settings.set("OMPI_MCA_pml", "ob1");
    settings.set("OMPI_MCA_btl", "self");
    // A single process is bound to no core: hwloc then need not look for cores, nor load OpenGL and OpenCL and query
    // ten X servers for their screens, which takes a fifth of a short run.
    settings.set("HWLOC_COMPONENTS", "no_os,stop");
    settings.set("HWLOC_PLUGINS_PATH", "/nonexistent");
  } else if (oversubscribed()) {
    settings.set("OMPI_MCA_mpi_yield_when_idle", "1");
  }
  check_mpi(MPI_Init(nullptr, nullptr), "MPI_Init");
}

void close_mpi() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  if (started != 0 && ended == 0) MPI_Finalize();
}

}  // namespace polybed::core
