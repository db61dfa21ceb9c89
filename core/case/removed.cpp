#include "core/case/removed.hpp"

namespace polybed::core {

namespace {

struct Removed {
  std::string_view path, word, instead;
};

constexpr std::string_view foreign_syamlal =
    "the law of Syamlal and O'Brien is not here (syamlal is another one); in a gas bed gidaspow is nearest";

constexpr Removed removed[] = {
    {"calibrate.film_gap", "", "it is 0.005 now; dem.roughness makes films thicker"},
    {"chooser.charge", "", "forces between charges are not modelled"},
    {"chooser.free_liquid", "", "take dem.surface_tension"},
    {"chooser.hamaker", "", "take dem.hamaker_constant"},
    {"chooser.roughness", "", "take dem.roughness"},
    {"dem.tangential_ratio", "", "it is 2/7 now"},
    {"effects.drag", "syamlal_obrien", foreign_syamlal},
    {"effects.drag", "syam_obrien", foreign_syamlal},
    {"fluid.tait_exponent", "", "it is 7 now; fluid.tait_stiffness sets the speed of sound"},
    {"tfm.friction_angle", "", "it is 28.5 degrees now"},
    {"tfm.momentum", "upwind", "(U.grad)U was removed, take \"conservative\", of the same order"},
    {"tfm.momentum", "limited", "(U.grad)U was removed, take \"conservative_limited\", of the same order"},
    {"tfm.wall_restitution", "", "it is 0.9 now"},
};

}  // namespace

std::string instead_of_removed(std::string_view path, std::string_view word) {
  for (const Removed& one : removed)
    if (one.path == path && one.word == word) return "; " + std::string(one.instead);
  return "";
}

}  // namespace polybed::core
