#include "core/output/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/error.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

void remove_quietly(const fs::path& path) {
  std::error_code ignored;  // a file that stays has no link to it
  fs::remove(path, ignored);
}

}  // namespace

std::string step_name(std::size_t step) {
  constexpr std::size_t digits = 6;
  const std::string number = std::to_string(step + 1);
  return std::string(digits - std::min(digits, number.size()), '0') + number;
}

fs::path step_path(const fs::path& directory, const std::string& name, std::size_t step) {
  return directory / name / (step_name(step) + ".h5");
}

StepWriter::StepWriter(fs::path run_directory, StepSeries series, std::optional<double> resume_time)
    : directory_(std::move(run_directory)), series_(std::move(series)) {
  make_folder(directory_ / series_.name);
  if (resume_time && fs::exists(index_path()))
    go_on(*resume_time);
  else
    begin();
}

fs::path StepWriter::index_path() const { return directory_ / (series_.name + ".h5"); }

fs::path StepWriter::path_of(std::size_t step) const { return step_path(directory_, series_.name, step); }

void StepWriter::begin() {
  index_.emplace(series_.kind);
  series_.head(*index_);
  index_->make_group("step");
  index_->make_rows("time_s", 0);
  if (!series_.count_name.empty()) index_->make_rows(series_.count_name, 0);
  remove_quietly(directory_ / (series_.name + ".xdmf"));
  index_->save(index_path(), Flush::content);
  for (std::size_t step = 0; fs::exists(path_of(step)); ++step) remove_quietly(path_of(step));
}

void StepWriter::go_on(double resume_time) {
  index_.emplace(index_path(), series_.kind);
  if (!series_.fits(*index_))
    throw FileError(fmt::format("{} has another {}: it cannot be continued", index_path().string(), series_.head_name));
  stored_.time = index_->read("time_s").values;
  const std::size_t all = stored_.time.size();
  while (!stored_.time.empty() && stored_.time.back() > resume_time) stored_.time.pop_back();
  const std::size_t kept = stored_.time.size();
  for (std::size_t step = kept; step < all; ++step) index_->remove("step/" + step_name(step));
  index_->keep_rows("time_s", kept, 0);
  if (!series_.count_name.empty()) {
    index_->keep_rows(series_.count_name, kept, 0);
    stored_.count = index_->read(series_.count_name).values;
  }
  write_description();
  for (std::size_t step = kept; step < all; ++step) remove_quietly(path_of(step));
}

void StepWriter::add(const OutputFile& content, double time_s, std::size_t count) {
  content.save(path_of(stored_.time.size()));
  add_written(time_s, count);
}

void StepWriter::add_written(double time_s, std::size_t count) {
  const std::size_t step = stored_.time.size();
  index_->link("step/" + step_name(step), series_.name + "/" + step_name(step) + ".h5", "/step");
  index_->append_row("time_s", std::span(&time_s, 1));
  stored_.time.push_back(time_s);
  if (!series_.count_name.empty()) {
    stored_.count.push_back(double(count));
    index_->append_row(series_.count_name, std::span(&stored_.count.back(), 1));
  }
  write_description();
}

void StepWriter::write_description() const {
  index_->save(index_path(), Flush::content);
  write_atomically(directory_ / (series_.name + ".xdmf"), series_.xdmf(stored_), Flush::nothing);
}

}  // namespace polybed::core
