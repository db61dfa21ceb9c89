#include "core/output/directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iterator>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark_name = ".polybed";
constexpr std::string_view mark_text = "polybed writes this directory: it replaces and removes files of its own here\n";

/// Records that name this program: directories from versions without marks contain one.
constexpr std::array<std::string_view, 6> records{"run.json",       "cost.json",      "comparison.json",
                                                  "inversion.json", "stability.json", "fuzz.json"};

/// Result files of a run, by the names that every writer uses.
constexpr std::array<std::string_view, 15> results{"history.csv",       "steps.csv",
                                                   "profiles.h5",       "fields.h5",
                                                   "fields.xdmf",       "particles.h5",
                                                   "particles.xdmf",    "checkpoint.h5",
                                                   "checkpoint.h5.new", "checkpoint.previous.h5",
                                                   "picture.png",       "stress_uncertainty.json",
                                                   "end.json",          "report.html",
                                                   "ports.vtp"};
constexpr std::array<std::string_view, 2> folders_of_steps{"fields", "particles"};
constexpr std::string_view unfinished = ".temporary";

bool is_file(const fs::path& path) {
  std::error_code none;  // for a file that does not exist
  return fs::is_regular_file(fs::symlink_status(path, none));
}

bool is_record(const fs::path& path) {
  if (!is_file(path)) return false;
  try {
    return filetype_of(path).starts_with("polybed ");
  } catch (const FileError&) {  // from another program
    return false;
  }
}

bool is_of_program(const fs::path& directory) {
  return is_file(directory / mark_name) ||
         std::any_of(records.begin(), records.end(), [&](auto name) { return is_record(directory / name); });
}

/// The name of a file in a directory that is not the program's; empty if there is none. Directories of the program can
/// be there, since a comparison is written around its runs.
std::string foreign_file(const fs::path& directory) {
  if (is_of_program(directory)) return {};
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    const bool ours = fs::is_directory(entry->symlink_status()) && is_of_program(entry->path());
    if (!ours) return entry->path().filename().string();
  }
  if (error) cannot("read the directory", directory, error.value());
  return {};
}

/// Opens the mark, or creates it. A mark that is a link or has a second name could be any file.
int opened_mark(const fs::path& directory) {
  make_directories(directory);
  if (const std::string name = foreign_file(directory); !name.empty())
    throw CaseError(fmt::format(
        "{0} contains files that polybed has not written, {1} for one: -o DIR names a new or an empty directory; an "
        "empty file {2} in {0} allows polybed to replace its own files there",
        directory.string(), name, mark_name));
  const fs::path path = directory / mark_name;
  const int mark = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (mark < 0) cannot("write", path, errno);
  struct stat status {};
  if (::fstat(mark, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1) return mark;
  ::close(mark);
  throw FileError(fmt::format("cannot write {}: it is no plain file", path.string()));
}

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

/// The lock owner's description of itself.
std::string holder(int mark) {
  std::array<char, 512> text{};
  const ssize_t count = ::pread(mark, text.data(), text.size(), 0);
  const std::string_view all(text.data(), std::size_t(std::max<ssize_t>(count, 0)));
  if (!all.starts_with(mark_text)) return "another process";
  return std::string(all.substr(mark_text.size(), all.find('\n', mark_text.size()) - mark_text.size()));
}

void lock(int mark, const fs::path& directory) {
  if (::flock(mark, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK)
      throw FileError(fmt::format("{}: {} writes into it; wait for its end, or name another directory by -o DIR",
                                  directory.string(), holder(mark)));
    if (errno != ENOLCK && errno != ENOTSUP) cannot("lock", directory, errno);  // file systems without locks
  }
  const std::string text = fmt::format("{}process {} on {}\n", mark_text, ::getpid(), host());
  if (::ftruncate(mark, 0) != 0 || ::pwrite(mark, text.data(), text.size(), 0) != ssize_t(text.size()))
    cannot("write", directory / mark_name, errno);
}

/// The missing directories on the way to a path, the deepest first.
std::vector<fs::path> missing(fs::path path) {
  std::vector<fs::path> found;
  std::error_code none;
  for (; !fs::exists(fs::symlink_status(path, none)) && path.has_relative_path(); path = path.parent_path())
    found.push_back(path);
  return found;
}

Descriptor locked(const fs::path& directory) {
  Descriptor mark(opened_mark(directory));
  lock(mark.number(), directory);
  return mark;
}

void remove_file(const fs::path& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT && errno != EISDIR) cannot("remove", path, errno);
}

/// 000001.h5, finished or not.
bool is_step(std::string_view name) {
  if (name.ends_with(unfinished)) name.remove_suffix(unfinished.size());
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return digits >= 6 && name.substr(digits) == ".h5";
}

void remove_steps(const fs::path& folder) {
  std::error_code none;  // for a file that does not exist
  if (!fs::is_directory(fs::symlink_status(folder, none))) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (is_step(entry.path().filename().string())) remove_file(entry.path());
  ::rmdir(folder.c_str());  // stays if there is more in it
}

}  // namespace

OutputDirectory::OutputDirectory(const fs::path& path)
    : path_(fs::absolute(path)), made_(missing(path_)), mark_(locked(path)) {}

OutputDirectory::~OutputDirectory() {
  std::error_code none;
  if (made_.empty() || std::distance(fs::directory_iterator(path_, none), {}) > 1) return;
  ::unlink((path_ / mark_name).c_str());
  for (const fs::path& made : made_) ::rmdir(made.c_str());  // a directory with content stays
}

void mark_directory(const fs::path& path) {
  Descriptor mark(opened_mark(path));
  struct stat status {};
  const bool empty = ::fstat(mark.number(), &status) == 0 && status.st_size == 0;
  if (empty && ::write(mark.number(), mark_text.data(), mark_text.size()) != ssize_t(mark_text.size()))
    cannot("write", path / mark_name, errno);
}

void remove_results(const fs::path& directory, std::span<const std::string_view> kept) {
  for (const std::string_view name : results) {
    if (std::find(kept.begin(), kept.end(), name) != kept.end()) continue;
    remove_file(directory / name);
    remove_file(directory / (std::string(name) + std::string(unfinished)));
  }
  for (const std::string_view name : folders_of_steps) remove_steps(directory / name);
}

}  // namespace polybed::core
