// This program, or one installed beside it, as another process, on one rank or several, so that one that fails or hangs
// ends nothing but itself.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace polybed::hard {

/// What is started.
struct ChildOrder {
  std::vector<std::string> words;  ///< behind the name of the program
  int ranks = 1;                   ///< above one by mpirun, which may be root, as with the launcher
  /// Files of what it prints; no output: this process's standard error; no errors: where its output goes.
  std::filesystem::path output = {}, errors = {};
  std::filesystem::path program = {};  ///< empty: this program
};

/// A process of a group of its own, which ends with this object and with this process, however these end.
class ChildProgram {
 public:
  /// Throws core::FileError, or core::MpiError above one rank, if it cannot be started.
  explicit ChildProgram(const ChildOrder& order);
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  [[nodiscard]] pid_t process() const { return process_; }
  /// Throws core::FileError if the process has got lost.
  [[nodiscard]] bool has_ended();
  /// Asks it to end, as mpirun then does with its ranks, which outlive an mpirun that is killed; ends its group if it
  /// does not within some seconds.
  void end();
  /// Of one that has ended; 128 and the number of the signal if one ended it.
  [[nodiscard]] int code() const { return code_; }

 private:
  pid_t process_ = 0;
  bool ended_ = false;
  int code_ = 0;
};

/// Starts a program, waits for its end and returns its code; throws as ChildProgram does.
/// \param look  called with it some hundred times a second
[[nodiscard]] int run_child(const ChildOrder& order, const std::function<void(const ChildProgram&)>& look = {});

}  // namespace polybed::hard
