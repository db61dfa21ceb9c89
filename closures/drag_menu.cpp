// The menu of drag laws and of partitions, by name.
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "closures/drag.hpp"

namespace polybed::closures {

namespace {

constexpr std::string_view no_partition = "none";

/// Forms with constants from a file are not in the menu.
template <class Law>
constexpr bool is_in_menu = !requires {
  Law::Base::is_fitted;
};

template <class Variant, std::size_t Place, class Body>
void see(Body& body) {
  using Law = std::variant_alternative_t<Place, Variant>;
  if constexpr (is_in_menu<Law>) body(std::type_identity<Law>{});
}

template <class Variant, class Body, std::size_t... Places>
void for_each_of(Body&& body, std::index_sequence<Places...>) {
  (see<Variant, Places>(body), ...);
}

template <class Variant, class Body>
void for_each_of(Body&& body) {
  for_each_of<Variant>(body, std::make_index_sequence<std::variant_size_v<Variant>>{});
}

/// The alternative with a name, with its guard; nothing if there is none.
template <class Variant>
std::optional<Variant> named(std::string_view name, Guard guard) {
  std::optional<Variant> found;
  for_each_of<Variant>([&](auto type) {
    using Law = typename decltype(type)::type;
    if (Law::name != name) return;
    Law chosen;
    chosen.base.guard = guard;
    found = chosen;
  });
  return found;
}

template <class Law>
constexpr bool is_mean = Law::name == Law::Base::name;

template <class Law>
DragLawInfo info_of(std::string_view help, std::string_view source) {
  return {std::string(Law::name), std::string(help), std::string(source), Law::obeys_sum_rule, is_mean<Law>};
}

/// Name of the one-size law that a mixture law is based on.
std::string_view base_name(const MixtureLaw& law) {
  return std::visit([](const auto& l) { return std::remove_cvref_t<decltype(l.base)>::name; }, law);
}

bool is_law_of_one_size(const DragLaw& law, std::string_view name) {
  const bool fitted = std::visit([](const auto& l) { return !is_in_menu<std::remove_cvref_t<decltype(l)>>; }, law.law);
  return fitted || base_name(law.law) == name;
}

}  // namespace

DragLaw drag_law(std::string_view name, Guard guard) {
  const auto law = named<MixtureLaw>(name, guard);
  if (!law) throw std::invalid_argument("unknown drag law '" + std::string(name) + "'");
  return {*law};
}

DragLaw drag_law(std::string_view name, std::string_view partition, Guard guard) {
  return shared_by(drag_law(name, guard), name, partition, guard);
}

DragLaw shared_by(const DragLaw& law, std::string_view name, std::string_view partition, Guard guard) {
  if (partition == no_partition) return law;
  const auto sharing = named<Partition>(partition, guard);
  if (!sharing) throw std::invalid_argument("unknown partition '" + std::string(partition) + "'");
  if (!is_law_of_one_size(law, name))
    throw std::invalid_argument("drag law '" + std::string(name) +
                                "' is no law of one size: a partition cannot share it");
  DragLaw shared = law;
  const DragLaw of_partition = drag_law(partition, guard);
  if (base_name(of_partition.law) == name)
    shared.law = of_partition.law;
  else
    shared.partition = sharing;
  return shared;
}

std::vector<DragLawInfo> drag_laws() {
  std::vector<DragLawInfo> list;
  for_each_of<MixtureLaw>([&](auto type) {
    using Law = typename decltype(type)::type;
    list.push_back(info_of<Law>(Law::help, Law::source));
  });
  return list;
}

std::vector<std::string> drag_law_names() {
  std::vector<std::string> names;
  for (const DragLawInfo& law : drag_laws()) names.push_back(law.name);
  return names;
}

std::vector<DragLawInfo> partitions() {
  std::vector<DragLawInfo> list;
  for_each_of<Partition>([&](auto type) {
    using Law = typename decltype(type)::type;
    list.push_back(info_of<Law>(Law::shares, Law::shares_source));
  });
  return list;
}

}  // namespace polybed::closures
