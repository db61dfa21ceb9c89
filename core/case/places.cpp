#include "core/case/places.hpp"

namespace polybed::core {

namespace {

std::string table_in(const std::string& path) { return path.substr(0, path.find('.')); }

}  // namespace

bool Places::add(const std::string& path, std::size_t entry, Place place) {
  return at_[path].emplace(entry, std::move(place)).second;
}

const Place* Places::find(const std::string& path, std::size_t entry) const {
  const auto entries = at_.find(path);
  if (entries == at_.end()) return nullptr;
  const auto found = entries->second.find(entry);
  return found == entries->second.end() ? nullptr : &found->second;
}

const Place* Places::of_entry(std::span<const std::string> keys, std::size_t entry) const {
  const std::string table = table_in(keys.front());
  for (const std::string& key : keys)
    if (const Place* place = table_in(key) == table ? find(key, entry) : nullptr) return place;
  return find(table, entry);
}

const Place* Places::of_any(std::span<const std::string> keys) const {
  for (const std::string& key : keys)
    if (const auto given = at_.find(key); given != at_.end())
      return given->second.size() == 1 ? &given->second.begin()->second : nullptr;  // else maybe another entry's
  for (const std::string& key : keys)
    if (const auto given = at_.find(table_in(key)); given != at_.end())
      return given->second.size() == 1 ? &given->second.begin()->second : nullptr;
  return nullptr;
}

CaseProblem Places::problem(std::span<const std::string> keys, std::string message,
                            std::optional<std::size_t> entry) const {
  const Place* place = entry ? of_entry(keys, *entry) : nullptr;
  if (place == nullptr) place = of_any(keys);
  if (place == nullptr) return {file_, 0, 0, std::move(message)};
  return {place->file, place->line, place->column, std::move(message)};
}

}  // namespace polybed::core
