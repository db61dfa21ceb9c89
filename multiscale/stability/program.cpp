#include "multiscale/stability/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "core/error.hpp"
#include "multiscale/stability/scratch.hpp"

namespace polybed::stability {

namespace {

/// What the new process does: only calls that are safe between fork and exec, words made before.
[[noreturn]] void become(std::vector<char*>& words, int said) {
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(said, STDERR_FILENO);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

std::string text_of_file(int file) {
  std::string text;
  std::array<char, 4096> buffer;
  ::lseek(file, 0, SEEK_SET);
  for (ssize_t count; (count = ::read(file, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), std::size_t(count));
  return text;
}

int code_of(int status) { return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status); }

}  // namespace

ProgramEnd run_program(int ranks, const std::vector<std::string>& words, const std::filesystem::path& until_exists) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::string> all;
  if (ranks > 1) all = {"mpirun", "-q", "--oversubscribe", "-n", std::to_string(ranks)};
  all.push_back(std::filesystem::read_symlink("/proc/self/exe").string());
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : all) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const Scratch folder;
  const int said = ::open((folder.path() / "said").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  const pid_t process = ::fork();
  if (process < 0) throw core::MpiError("no process can be started");
  if (process == 0) become(pointers, said);
  int status = 0;
  for (bool killed = false;;) {
    const pid_t ended = ::waitpid(process, &status, until_exists.empty() ? 0 : WNOHANG);
    if (ended == process) break;
    if (ended < 0 && errno != EINTR) break;
    if (!killed && !until_exists.empty() && std::filesystem::exists(until_exists)) {
      ::kill(process, SIGKILL);
      killed = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ProgramEnd end{code_of(status), text_of_file(said), 0};
  ::close(said);
  end.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (end.code == 127) throw core::MpiError("mpirun cannot be started");
  return end;
}

}  // namespace polybed::stability
