// The choices of a case file: what a key may say in a word, and the words.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace polybed::core {

enum class Boundary { wall, periodic };
constexpr std::array<std::string_view, 2> names(Boundary) { return {"wall", "periodic"}; }

/// Of the cross-section of a column; axisymmetric: round, and everything alike all around its axis.
enum class ColumnShape { box, cylinder, axisymmetric };
constexpr std::array<std::string_view, 3> names(ColumnShape) { return {"box", "cylinder", "axisymmetric"}; }

/// Of a wall inside the column.
enum class WallShape { flat, cylinder, cone };
constexpr std::array<std::string_view, 3> names(WallShape) { return {"flat", "cylinder", "cone"}; }

/// Whether solids leave at the top.
enum class Outlet { screen, open };
constexpr std::array<std::string_view, 2> names(Outlet) { return {"screen", "open"}; }

enum class Compressibility { incompressible, tait, ideal_gas };
constexpr std::array<std::string_view, 3> names(Compressibility) { return {"incompressible", "tait", "ideal_gas"}; }

/// Of sizes by volume.
enum class SizeLaw { lognormal, sieves };
constexpr std::array<std::string_view, 2> names(SizeLaw) { return {"lognormal", "sieves"}; }

/// The bed at time zero.
enum class StartKind { mixed, layered, settled, random, checkpoint, list };
constexpr std::array<std::string_view, 6> names(StartKind) {
  return {"mixed", "layered", "settled", "random", "checkpoint:FILE", "list:FILE"};
}

enum class ColumnEnd { bottom, top };
constexpr std::array<std::string_view, 2> names(ColumnEnd) { return {"bottom", "top"}; }

/// Where something enters or leaves: the ends, and the sides at x = 0, x = width, z = 0 and z = depth.
enum class ColumnFace { bottom, top, left, right, front, back };
constexpr std::array<std::string_view, 6> names(ColumnFace) {
  return {"bottom", "top", "left", "right", "front", "back"};
}
/// The axis across a face: 0 = x (width), 1 = y (height), 2 = z (depth).
constexpr int axis_of(ColumnFace face) { return face <= ColumnFace::top ? 1 : face <= ColumnFace::right ? 0 : 2; }
/// The low (0) or the high (1) end of that axis.
constexpr int side_of(ColumnFace face) { return static_cast<int>(face) % 2; }
constexpr bool is_side(ColumnFace face) { return face > ColumnFace::top; }
constexpr ColumnFace face_of(int axis, int side) { return static_cast<ColumnFace>((axis == 1 ? 0 : axis + 2) + side); }
/// The axis that coordinate n of a corner on a face is along, in the order width, depth, height.
constexpr int axis_along(ColumnFace face, int dimensions, std::size_t n) {
  if (axis_of(face) == 1) return n == 0 ? 0 : 2;
  if (axis_of(face) == 0) return n == 0 && dimensions == 3 ? 2 : 1;
  return n == 0 ? 0 : 1;
}

/// What a scene is run for: means, or how they come about.
enum class Purpose { steady, transient };
constexpr std::array<std::string_view, 2> names(Purpose) { return {"steady", "transient"}; }

/// What follows when forces that were left out exceed the tolerance; automatic: warn where a role is "auto", else off.
enum class MonitorMode { automatic, off, warn, stop };
constexpr std::array<std::string_view, 4> names(MonitorMode) { return {"auto", "off", "warn", "stop"}; }

enum class TfmIntegrator { automatic, explicit_steps, split_steps, implicit_steps };
constexpr std::array<std::string_view, 4> names(TfmIntegrator) { return {"auto", "explicit", "imex", "implicit"}; }

/// Of the solids fractions at faces.
enum class FractionFlux { limited, upwind };
constexpr std::array<std::string_view, 2> names(FractionFlux) { return {"limited", "upwind"}; }

/// Convection of velocities in conservative form: of first order, or of second with a limiter.
enum class Momentum { automatic, conservative, conservative_limited };
constexpr std::array<std::string_view, 3> names(Momentum) { return {"auto", "conservative", "conservative_limited"}; }

/// Whose momentum the gradient of the pressure is in: all phases' or the fluid's.
enum class PressureForm { A, B };
constexpr std::array<std::string_view, 2> names(PressureForm) { return {"A", "B"}; }

/// Velocity of the solids along walls.
enum class SolidsWall { free_slip, no_slip, johnson_jackson };
constexpr std::array<std::string_view, 3> names(SolidsWall) { return {"free_slip", "no_slip", "johnson_jackson"}; }

/// Maximum packing; automatic: the settled bed then has bed.solids_fraction.
enum class PackingRule { automatic, fedors_landel, yu_standish };
constexpr std::array<std::string_view, 3> names(PackingRule) { return {"auto", "fedors_landel", "yu_standish"}; }

enum class KineticTheory { garzo_dufty, lun };
constexpr std::array<std::string_view, 2> names(KineticTheory) { return {"garzo_dufty", "lun"}; }

enum class RadialDistribution { torquato, carnahan_starling };
constexpr std::array<std::string_view, 2> names(RadialDistribution) { return {"torquato", "carnahan_starling"}; }

/// How particles are averaged for the fluid.
enum class Kernel { automatic, bilinear, diffusion };
constexpr std::array<std::string_view, 3> names(Kernel) { return {"auto", "bilinear", "diffusion"}; }

/// A particle's own part in the averages that it feels.
enum class OwnShare { kept, removed };
constexpr std::array<std::string_view, 2> names(OwnShare) { return {"kept", "removed"}; }

/// Which rank solves for the fluid: each for all of it, or for its block.
enum class FluidRanks { automatic, each, shared };
constexpr std::array<std::string_view, 3> names(FluidRanks) { return {"auto", "each", "shared"}; }

enum class Tangential { hdd, mindlin, mindlin_deresiewicz, linear };
constexpr std::array<std::string_view, 4> names(Tangential) {
  return {"hdd", "mindlin", "mindlin_deresiewicz", "linear"};
}

/// Near separation the dashpot may not pull, or may.
enum class Tail { clip, keep };
constexpr std::array<std::string_view, 2> names(Tail) { return {"clip", "keep"}; }

enum class DemIntegrator { automatic, thesis, synchronised };
constexpr std::array<std::string_view, 3> names(DemIntegrator) { return {"auto", "thesis", "synchronised"}; }

/// Of the boxes of a calibration.
enum class BoxRegime { automatic, dry, wet, bed };
constexpr std::array<std::string_view, 4> names(BoxRegime) { return {"auto", "dry", "wet", "bed"}; }

/// Of the numbers of a resolved flow.
enum class Precision { one, two };
constexpr std::array<std::string_view, 2> names(Precision) { return {"single", "double"}; }

/// Of the spheres of a resolved flow: all at rest, one species past the others, or under their own forces.
enum class SphereMotion { held, moving, free };
constexpr std::array<std::string_view, 3> names(SphereMotion) { return {"held", "moving", "free"}; }

/// A choice as a case file writes it.
template <class Choice>
requires std::is_enum_v<Choice>
constexpr std::string_view name_of(Choice choice) { return names(choice)[static_cast<std::size_t>(choice)]; }

/// The choice that a case file writes so. Throws std::invalid_argument if none is.
template <class Choice>
requires std::is_enum_v<Choice> Choice choice_of(std::string_view word) {
  constexpr auto words = names(Choice{});
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) throw std::invalid_argument("no such choice: " + std::string(word));
  return static_cast<Choice>(found - words.begin());
}

}  // namespace polybed::core
