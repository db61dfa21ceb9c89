// The choices of a case file: the words that a key accepts.
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

/// Mean pressure gradient between joined ends, where it is not a number: it carries the weight of all that is inside.
enum class MeanGradient { weight };
constexpr std::array<std::string_view, 1> names(MeanGradient) { return {"weight"}; }

/// Cross-section of a column. Axisymmetric: round, and everything depends on radius and height alone.
enum class ColumnShape { box, cylinder, axisymmetric };
constexpr std::array<std::string_view, 3> names(ColumnShape) { return {"box", "cylinder", "axisymmetric"}; }

/// Shape of a wall inside the column.
enum class WallShape { flat, cylinder, cone, rod };
constexpr std::array<std::string_view, 4> names(WallShape) { return {"flat", "cylinder", "cone", "rod"}; }

/// Whether solids leave at the top; under a lid nothing does.
enum class Outlet { screen, open, lid };
constexpr std::array<std::string_view, 3> names(Outlet) { return {"screen", "open", "lid"}; }

enum class Compressibility { incompressible, tait, ideal_gas };
constexpr std::array<std::string_view, 3> names(Compressibility) { return {"incompressible", "tait", "ideal_gas"}; }

/// Law of the size distribution, by volume.
enum class SizeLaw { lognormal, sieves };
constexpr std::array<std::string_view, 2> names(SizeLaw) { return {"lognormal", "sieves"}; }

/// State of the bed at time zero.
enum class StartKind { mixed, layered, settled, random, checkpoint, list };
constexpr std::array<std::string_view, 6> names(StartKind) {
  return {"mixed", "layered", "settled", "random", "checkpoint:FILE", "list:FILE"};
}

enum class ColumnEnd { bottom, top };
constexpr std::array<std::string_view, 2> names(ColumnEnd) { return {"bottom", "top"}; }

/// Where fluid or solids enter or leave: the ends, and the sides at x = 0, x = width, z = 0 and z = depth.
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
/// The axis of coordinate n of a corner on a face, in the order width, depth, height.
constexpr int axis_along(ColumnFace face, int dimensions, std::size_t n) {
  if (axis_of(face) == 1) return n == 0 ? 0 : 2;
  if (axis_of(face) == 0) return n == 0 && dimensions == 3 ? 2 : 1;
  return n == 0 ? 0 : 1;
}

/// Purpose of a run: mean values, or how they develop.
enum class Purpose { steady, transient };
constexpr std::array<std::string_view, 2> names(Purpose) { return {"steady", "transient"}; }

/// The response when neglected forces exceed the tolerance. Automatic: warn where a role is "auto", else off.
enum class MonitorMode { automatic, off, warn, stop };
constexpr std::array<std::string_view, 4> names(MonitorMode) { return {"auto", "off", "warn", "stop"}; }

enum class TfmIntegrator { automatic, explicit_steps, split_steps, implicit_steps };
constexpr std::array<std::string_view, 4> names(TfmIntegrator) { return {"auto", "explicit", "imex", "implicit"}; }

/// Flux of the solids fractions at faces.
enum class FractionFlux { limited, upwind };
constexpr std::array<std::string_view, 2> names(FractionFlux) { return {"limited", "upwind"}; }

/// Convection of velocities in conservative form: first order, or second order with a limiter.
enum class Momentum { automatic, conservative, conservative_limited };
constexpr std::array<std::string_view, 3> names(Momentum) { return {"auto", "conservative", "conservative_limited"}; }

/// The momentum equations that contain the pressure gradient: of all phases or of the fluid alone.
enum class PressureForm { A, B };
constexpr std::array<std::string_view, 2> names(PressureForm) { return {"A", "B"}; }

/// Velocity of the solids along walls.
enum class SolidsWall { free_slip, no_slip, johnson_jackson };
constexpr std::array<std::string_view, 3> names(SolidsWall) { return {"free_slip", "no_slip", "johnson_jackson"}; }

/// Maximum packing. Automatic: the settled bed then has bed.solids_fraction.
enum class PackingRule { automatic, fedors_landel, yu_standish };
constexpr std::array<std::string_view, 3> names(PackingRule) { return {"auto", "fedors_landel", "yu_standish"}; }

enum class KineticTheory { garzo_dufty, lun };
constexpr std::array<std::string_view, 2> names(KineticTheory) { return {"garzo_dufty", "lun"}; }

enum class RadialDistribution { torquato, carnahan_starling };
constexpr std::array<std::string_view, 2> names(RadialDistribution) { return {"torquato", "carnahan_starling"}; }

/// How particles are averaged for the fluid.
enum class Kernel { automatic, bilinear, diffusion };
constexpr std::array<std::string_view, 3> names(Kernel) { return {"auto", "bilinear", "diffusion"}; }

/// Whether the averages that a particle feels include its own contribution.
enum class OwnShare { kept, removed };
constexpr std::array<std::string_view, 2> names(OwnShare) { return {"kept", "removed"}; }

/// How ranks solve for the fluid: each solves for the whole column, or for its own block.
enum class FluidRanks { automatic, each, shared };
constexpr std::array<std::string_view, 3> names(FluidRanks) { return {"auto", "each", "shared"}; }

enum class Tangential { hdd, mindlin, mindlin_deresiewicz, linear };
constexpr std::array<std::string_view, 4> names(Tangential) {
  return {"hdd", "mindlin", "mindlin_deresiewicz", "linear"};
}

/// Whether the dashpot can pull near separation (keep) or not (clip).
enum class Tail { clip, keep };
constexpr std::array<std::string_view, 2> names(Tail) { return {"clip", "keep"}; }

enum class DemIntegrator { automatic, thesis, synchronised };
constexpr std::array<std::string_view, 3> names(DemIntegrator) { return {"auto", "thesis", "synchronised"}; }

/// Regime of the boxes of a calibration.
enum class BoxRegime { automatic, dry, wet, bed };
constexpr std::array<std::string_view, 4> names(BoxRegime) { return {"auto", "dry", "wet", "bed"}; }

/// Precision of the numbers of a resolved flow.
enum class Precision { one, two };
constexpr std::array<std::string_view, 2> names(Precision) { return {"single", "double"}; }

/// Motion of the spheres in a resolved flow: all at rest, one species past the others, or under their own forces.
enum class SphereMotion { held, moving, free };
constexpr std::array<std::string_view, 3> names(SphereMotion) { return {"held", "moving", "free"}; }

/// The word of a choice in a case file.
template <class Choice>
requires std::is_enum_v<Choice>
constexpr std::string_view name_of(Choice choice) { return names(choice)[static_cast<std::size_t>(choice)]; }

/// The choice that a word of a case file names. Throws std::invalid_argument if it names none.
template <class Choice>
requires std::is_enum_v<Choice> Choice choice_of(std::string_view word) {
  constexpr auto words = names(Choice{});
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) throw std::invalid_argument("no such choice: " + std::string(word));
  return static_cast<Choice>(found - words.begin());
}

}  // namespace polybed::core
