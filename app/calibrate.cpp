// polybed calibrate: hands over to the Python package, which asks this program for boxes and their results.
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <optional>

#include "app/calibrate_service.hpp"
#include "app/options.hpp"
#include "core/numerics/mpi_start.hpp"
#include "multiscale/python_module.hpp"

namespace polybed::app {

namespace {

constexpr const char* study = "polybed.calibration";

/// Words for the command's own use: `--serve`, and `--box PARENT FILE CASE POINT SETTING...`.
bool serves(const std::vector<std::string>& words) { return !words.empty() && words[0] == "--serve"; }
bool is_box(const std::vector<std::string>& words) { return words.size() > 4 && words[0] == "--box"; }

/// Under mpirun the first rank starts Python, and all ranks run the boxes that it asks for.
core::ExitCode calibrate_on_ranks(std::vector<std::string> words) {
  const std::shared_ptr<const core::Ranks> ranks = core::Ranks::of_program();
  words.insert(words.begin(), "--on-ranks");
  std::optional<AskingModule> python;
  core::on_first(ranks.get(), [&] { python.emplace(study, words); });
  const int socket = python ? python->socket() : -1;
  answer_calibration(socket, socket, ranks);
  return core::ExitCode(std::stoi(core::said_by(ranks.get(), 0, python ? std::to_string(python->wait()) : "")));
}

}  // namespace

bool calibrate_needs_mpi(const std::vector<std::string>& words) {
  if (is_box(words)) return words[4].starts_with("bed");
  return core::started_by_launcher() && !serves(words);
}

core::ExitCode run_calibrate(const std::vector<std::string>& words) {
  if (serves(words)) {
    answer_calibration(STDIN_FILENO, STDOUT_FILENO, nullptr);
    return core::ExitCode::done;
  }
  if (is_box(words)) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no box outlives the command that has asked for it
    if (std::to_string(::getppid()) != words[1]) return core::ExitCode::stopped;
    run_box_into(words[2], words[3], {words.begin() + 5, words.end()}, words[4]);
    return core::ExitCode::done;
  }
  if (core::started_by_launcher()) return calibrate_on_ranks(words);
  become_python(study, words);
}

}  // namespace polybed::app
