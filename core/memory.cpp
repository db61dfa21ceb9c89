#include "core/memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace polybed::core {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

std::string content(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The number at the start of a file; infinite if there is none ("max").
double number_of_file(const std::string& path) {
  const std::string text = content(path);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? value : infinite;
}

/// Memory left in a control group, version 2 or 1; its cached files count as free.
double left_by_group(const std::string& folder) {
  const double used = number_of_line(content(folder + "/memory.stat"), "inactive_file");
  const double files = std::max(used, 0.0);
  const double limit =
      std::min(number_of_file(folder + "/memory.max"), number_of_file(folder + "/memory.limit_in_bytes"));
  const double now =
      std::min(number_of_file(folder + "/memory.current"), number_of_file(folder + "/memory.usage_in_bytes"));
  return limit < infinite && now < infinite ? std::max(limit - std::max(now - files, 0.0), 0.0) : infinite;
}

/// The memory left in the groups of this process: each group, and every group around it, has its own limit.
double left_by_groups() {
  double least = std::min(left_by_group("/sys/fs/cgroup"), left_by_group("/sys/fs/cgroup/memory"));
  const std::string text = content("/proc/self/cgroup");
  if (!text.starts_with("0::/")) return least;
  std::string group = text.substr(3, text.find('\n') - 3);
  for (; group.size() > 1; group.resize(group.rfind('/')))
    least = std::min(least, left_by_group("/sys/fs/cgroup" + group));
  return least;
}

double left_of_addresses() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return infinite;
  const double used = number_of_line(content("/proc/self/status"), "VmSize");
  return std::max(double(limit.rlim_cur) - std::max(used, 0.0), 0.0);
}

}  // namespace

double number_of_line(std::string_view text, std::string_view name) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (!line.starts_with(name) || line.size() == name.size()) continue;
    if (const char after = line[name.size()]; after != ':' && after != ' ') continue;
    const std::size_t begin = line.find_first_of("0123456789", name.size());
    if (begin == std::string_view::npos) return -1;
    double value = 0;
    std::from_chars(line.data() + begin, line.data() + line.size(), value);
    return line.ends_with("kB") ? 1024 * value : value;
  }
  return -1;
}

AvailableMemory available_memory() {
  AvailableMemory least{infinite, "nothing that is known"};
  const auto see = [&](double bytes, const char* limit) {
    if (bytes < least.bytes) least = {bytes, limit};
  };
  if (const double free = number_of_line(content("/proc/meminfo"), "MemAvailable"); free >= 0)
    see(free, "the machine's free memory");
  see(left_by_groups(), "the limit of this control group");
  see(left_of_addresses(), "the limit of this process (ulimit -v)");
  return least;
}

ProcessMemory process_memory() {
  const std::string status = content("/proc/self/status");
  return {std::max(number_of_line(status, "VmRSS"), 0.0), std::max(number_of_line(status, "VmHWM"), 0.0)};
}

void give_back_what_is_freed() {
#ifdef __GLIBC__
  constexpr int large = 1 << 22, many = 1 << 16;  // bytes; arrays at once
  mallopt(M_MMAP_THRESHOLD, large);
  mallopt(M_MMAP_MAX, many);
  mallopt(M_TRIM_THRESHOLD, large);
#endif
}

}  // namespace polybed::core
