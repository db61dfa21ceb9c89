// Hard cases of input: I1 to I10. What is wrong is refused at once, with its place, key, value and range.
#include <fmt/format.h>

#include <fstream>
#include <functional>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/checkpoint.hpp"
#include "core/timers.hpp"
#include "hard/cases.hpp"
#include "hard/program.hpp"
#include "multiscale/roles.hpp"
#include "scenes/scratch.hpp"

namespace polybed::hard {

namespace {

namespace fs = std::filesystem;

/// A case that is right, in which a line may be replaced by another.
std::string sound_case(const std::string& line = "", const std::string& other = "") {
  std::string text =
      "[column]\nsize = [0.06, 0.3]\ncells = [6, 30]\n[fluid]\nname = \"water\"\ntemperature = \"15 degC\"\n"
      "[[species]]\nname = \"fine\"\ndiameter = \"0.8 mm\"\ndensity = 1395\n"
      "[bed]\nvolume_share = [1]\nstatic_height = 0.06\nsolids_fraction = 0.6\nstart_solids_fraction = 0.5\n"
      "[inlet]\nsuperficial_velocity = \"10 mm/s\"\n[effects]\ndrag = \"cello\"\n[run]\nuntil = 1\n";
  if (line.empty()) return text;
  const std::size_t place = text.find(line);
  if (place == std::string::npos) throw std::logic_error("no such line: " + line);
  return text.replace(place, line.size(), other);
}

/// A text that must be refused by the parser within a second, by a message with all of some words, at a line.
void refused(Trial& trial, const std::string& text, const std::vector<std::string>& words, bool with_line = true) {
  const double begin = core::cpu_seconds();
  bool told = false;
  try {
    (void)core::parse_case(text, "case.toml", {}, multiscale::all_roles(), multiscale::size_classes);
  } catch (const core::CaseError& error) {
    const std::string said = error.what();
    told = !with_line || said.find("case.toml:") == 0;
    for (const std::string& word : words) told = told && said.find(word) != std::string::npos;
    if (!told) trial.report("message without " + fmt::format("{}", fmt::join(words, " or ")) + ": " + said, 1);
  }
  trial.measure("V16 refused with place, key and value", told ? 0 : 1, 0);
  trial.measure("time until it is refused, s", core::cpu_seconds() - begin, 1);
}

/// I1: numbers that are none.
void no_numbers(Trial& trial) {
  refused(trial, sound_case("density = 1395", "density = 1e400"), {"1e400"});  // no number of TOML: its key is not read
  for (const std::string value : {"nan", "inf", "-inf", "\"1e400 mm\"", "\"nan mm\""})
    refused(trial, sound_case("density = 1395", "density = " + value), {"density"});
}

/// I2: numbers that cannot be.
void impossible_numbers(Trial& trial) {
  refused(trial, sound_case("diameter = \"0.8 mm\"", "diameter = \"-0.8 mm\""), {"diameter", "-0.8"});
  refused(trial, sound_case("density = 1395", "density = -1395"), {"density", "-1395"});
  refused(trial, sound_case("temperature = \"15 degC\"", "density = 1000\nviscosity = -1e-3"), {"viscosity"});
}

/// I3: units missing or mixed; the guess is shown.
void units(Trial& trial) {
  refused(trial, sound_case("diameter = \"0.8 mm\"", "diameter = 0.8"), {"diameter", "0.8", "mm"});
  refused(trial, sound_case("density = 1395", "density = \"1395 mm\""), {"density", "mm"});
  refused(trial, sound_case("until = 1", "until = \"1 kg\""), {"until"});
}

/// I4: a bed denser than its packing.
void too_dense(Trial& trial) {
  refused(trial, sound_case("solids_fraction = 0.6", "solids_fraction = 1.2"), {"solids_fraction", "1.2"});
  refused(trial, sound_case("start_solids_fraction = 0.5", "start_solids_fraction = 0.62"),
          {"0.62", "settled bed, 0.6"}, false);
}

/// The program on a case file; what it said.
ProgramEnd check(const std::string& text) {
  const scenes::Scratch folder;
  std::ofstream(folder.path() / "case.toml") << text;
  return run_program(1, {"check", (folder.path() / "case.toml").string()});
}

/// I5: an inlet that carries every particle away is told, and runs.
void too_fast_inlet(Trial& trial) {
  const ProgramEnd end = check(sound_case("\"10 mm/s\"", "\"5 m/s\""));
  trial.measure("V16 code", end.code, 0);
  const bool told = end.printed.find("5 m/s is above the terminal velocity of fine") != std::string::npos;
  trial.measure("V16 says what becomes of the particles", told ? 0 : 1, 0);
  refused(trial, sound_case("\"10 mm/s\"", "\"5000 m/s\""), {"superficial_velocity", "1000"});
}

/// I6: a key that there is not; the nearest one is suggested.
void unknown_key(Trial& trial) {
  refused(trial, sound_case("diameter = ", "diametre = "), {"diametre", "diameter"});
  refused(trial, sound_case("drag = \"cello\"", "drag = \"chello\""), {"chello", "cello"});
}

/// I7: no size, no particles, more cells than memory.
void no_size(Trial& trial) {
  refused(trial, sound_case("size = [0.06, 0.3]", "size = [0, 0.3]"), {"column.size"});
  refused(trial, sound_case("cells = [6, 30]", "cells = [0, 30]"), {"column.cells"});
  refused(trial, sound_case("cells = [6, 30]", "cells = [1000000, 1000000]"), {"column.cells"}, false);
  const ProgramEnd large = check(sound_case("cells = [6, 30]", "cells = [40000, 50000]"));
  trial.measure("V16 code of too little memory", std::abs(large.code - 2), 0);
  trial.measure("V16 says memory", large.said.find("memory") != std::string::npos ? 0 : 1, 0);
}

/// I8: a checkpoint that is cut short or changed is told before it is read.
void cut_checkpoint(Trial& trial) {
  const scenes::Scratch folder;
  const fs::path path = folder.path() / "checkpoint.h5";
  core::Checkpoint state;
  state.arrays["state"] = std::vector<double>(1000, 1.5);
  core::write_checkpoint(path, state);
  const auto size = fs::file_size(path);
  trial.measure("whole", core::read_checkpoint(path).arrays == state.arrays ? 0 : 1, 0);
  const auto told = [&] {
    try {
      (void)core::read_checkpoint(path);
      return false;
    } catch (const core::FileError&) {
      return true;
    }
  };
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(std::streamoff(size / 2));
    file.put('\x55');
  }
  trial.measure("V16 a changed byte is told", told() ? 0 : 1, 0);
  for (const double share : {0.99, 0.5, 0.01, 0.0}) {
    fs::resize_file(path, std::uintmax_t(share * double(size)));
    trial.measure("V16 a cut file is told", told() ? 0 : 1, 0);
  }
}

/// I9: line ends of other systems are as good; keys that stand twice, and files beyond all measure, are refused.
void odd_files(Trial& trial) {
  std::string text;
  for (const char c : sound_case()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto parsed = [](const std::string& t) {
    return core::resolved_case(core::parse_case(t, "case.toml", {}, multiscale::all_roles(), multiscale::size_classes));
  };
  trial.measure("the same case with CR LF", parsed(text) == parsed(sound_case()) ? 0 : 1, 0);
  refused(trial, sound_case("density = 1395", "density = 1395\ndensity = 1395"), {"density"});
  refused(trial, sound_case() + std::string(100, '\0'), {}, false);
  // A comment is legal whatever its length: nothing but the size can be wrong.
  const ProgramEnd huge = check(sound_case() + "# " + std::string(20'000'000, 'a') + "\n");
  const bool by_size =
      huge.code == int(core::ExitCode::file) && huge.said.find("bytes is too long") != std::string::npos;
  trial.measure("V16 read, or refused for its size", huge.code == 0 || by_size ? 0 : 1, 0);
}

/// I10: legal and absurd: a sphere larger than its column.
void absurd(Trial& trial) { refused(trial, sound_case("diameter = \"0.8 mm\"", "diameter = \"0.5 m\""), {}, false); }

}  // namespace

std::vector<HardCase> input_cases() {
  const std::vector<Treatment> input{{"input", "", ""}};
  return {{"I1", "values that are not numbers", {}, input, no_numbers},
          {"I2", "impossible values", {}, input, impossible_numbers},
          {"I3", "units missing or mixed", {}, input, units},
          {"I4", "beds denser than spheres pack", {}, input, too_dense},
          {"I5", "an inlet beyond all bounds", {}, input, too_fast_inlet},
          {"I6", "unknown keys and laws", {}, input, unknown_key},
          {"I7", "no size, or more cells than memory", {}, input, no_size},
          {"I8", "checkpoints cut or changed", {}, input, cut_checkpoint},
          {"I9", "line ends, keys twice, huge files", {}, input, odd_files},
          {"I10", "legal but absurd cases", {}, input, absurd}};
}

}  // namespace polybed::hard
