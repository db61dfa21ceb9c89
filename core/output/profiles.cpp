#include "core/output/profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

const FileKind kind{"polybed profiles", 1};

bool is_axis(const std::string& name) { return name == "time_s" || name == "y_m"; }

void refuse_if_not_finite(const std::string& name, const std::vector<double>& row, double time) {
  for (std::size_t j = 0; j < row.size(); ++j)
    if (!std::isfinite(row[j]))
      throw NumericsError(
          fmt::format("the profile {} is {} in row {} at t = {} s: not written", name, row[j], j, time));
}

}  // namespace

ProfileWriter::ProfileWriter(const fs::path& run_directory, std::vector<double> height, std::vector<std::string> names,
                             std::optional<double> resume_time)
    : path_(run_directory / "profiles.h5"), height_(std::move(height)), names_(std::move(names)) {
  if (resume_time && fs::exists(path_))
    go_on(*resume_time);
  else
    begin();
  file_->save(path_, Flush::content);
}

void ProfileWriter::begin() {
  file_.emplace(kind);
  file_->write("y_m", {height_.size()}, height_);
  file_->make_rows("time_s", 0);
  for (const std::string& name : names_) file_->make_rows(name, height_.size());
}

void ProfileWriter::go_on(double resume_time) {
  file_.emplace(path_, kind);
  const bool same = file_->read("y_m").values == height_ &&
                    std::all_of(names_.begin(), names_.end(), [&](const auto& n) { return file_->has(n); });
  if (!same) throw FileError(path_.string() + " has other heights or profiles: it cannot be continued");
  const std::vector<double> times = file_->read("time_s").values;
  const auto kept = std::size_t(std::upper_bound(times.begin(), times.end(), resume_time) - times.begin());
  file_->keep_rows("time_s", kept, 0);
  for (const std::string& name : names_) file_->keep_rows(name, kept, height_.size());
}

void ProfileWriter::write_row(double time_s, std::span<const std::vector<double>> rows) {
  if (rows.size() != names_.size())
    throw std::invalid_argument(fmt::format("{} profiles for {} names", rows.size(), names_.size()));
  for (std::size_t n = 0; n < rows.size(); ++n) refuse_if_not_finite(names_[n], rows[n], time_s);
  for (std::size_t n = 0; n < rows.size(); ++n) file_->append_row(names_[n], rows[n]);
  file_->append_row("time_s", std::span(&time_s, 1));
  file_->save(path_, Flush::content);
}

const DataSet& Profiles::of(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw FileError("profiles.h5 has no " + name);
  return values[std::size_t(found - names.begin())];
}

Profiles read_profiles(const fs::path& run_directory) {
  const fs::path path = run_directory / "profiles.h5";
  const OutputFile file(path, kind);
  const auto read = [&](const std::string& name) {
    DataSet data = file.read(name);
    for (const double value : data.values)
      if (!std::isfinite(value)) throw FileError(fmt::format("{} is damaged: {} is not finite", path.string(), name));
    return data;
  };
  Profiles profiles{read("time_s").values, read("y_m").values, {}, {}};
  for (const std::string& name : file.names("/"))
    if (!is_axis(name)) {
      profiles.names.push_back(name);
      profiles.values.push_back(read(name));
    }
  return profiles;
}

}  // namespace polybed::core
