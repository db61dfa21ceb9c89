// The scene: the content of a case file in SI units, one plain struct per table. It contains no law and no equation.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/case/choices.hpp"
#include "core/case/places.hpp"

namespace polybed::core {

struct Column {
  ColumnShape shape = ColumnShape::box;   ///< a cylinder is upright; its diameter is the width and the depth
  std::vector<double> given_size;         ///< as the case gives it: width, height or width, depth, height, m
  std::vector<std::int64_t> given_cells;  ///< likewise
  /// Height and diameter of a round column, m, upward, linear between. Two at one height are a step. Empty: uniform.
  std::vector<std::pair<double, double>> profile;
  std::optional<double> grading, graded_above, grading_across;  ///< ratio of heights, above a height, m; of widths
  std::optional<double> depth;                ///< of a 2-D column, m; else twice the largest diameter and skin
  int dimensions = 2;                         ///< derived, like the next two
  std::array<double, 3> size{};               ///< width, height, depth, m (axes x, y, z; 2-D: depth is `depth`)
  std::array<int, 3> cells{1, 1, 1};          ///< along x, y, z; 1 along z in 2-D
  std::vector<double> layers;                 ///< derived: heights of graded layers of cells, m; empty: all alike
  std::array<std::vector<double>, 2> across;  ///< derived: sides of graded cells along x and z, m; empty: all alike
  Boundary sides = Boundary::wall, ends = Boundary::wall;  ///< ends: bottom and top
  std::variant<MeanGradient, double> pressure_gradient{};  ///< mean, of p between joined ends, Pa/m
  double gravity = 9.81;                                   ///< m/s2, along `down`
  std::vector<double> gravity_direction;  ///< as the case gives it, in the order of given_size; empty: down
  std::array<double, 3> down{0, -1, 0};   ///< derived: its unit vector on the axes x, y, z
  double shear_rate = 0;                  ///< Lees-Edwards, dv_x/dy, 1/s; key of [dem]
  Outlet outlet = Outlet::screen;
  bool closed = false;  ///< walls all round: no inlet, no outlet

  [[nodiscard]] bool is_round() const { return shape == ColumnShape::cylinder; }
  [[nodiscard]] bool around_axis() const { return shape == ColumnShape::axisymmetric; }
  [[nodiscard]] bool is_tapered() const { return !profile.empty(); }
  /// Side of a cell along an axis, m; in a graded column of those at the bottom or the walls, the smallest.
  [[nodiscard]] double cell(std::size_t axis) const {
    const std::vector<double>& graded = axis == 1 ? layers : across[axis / 2];
    return graded.empty() ? size[axis] / cells[axis] : graded.front();
  }
  /// Number of layers of the lowest cells' height, as without grading.
  [[nodiscard]] long even_layers() const { return std::lround(size[1] / cell(1)); }
  /// Area of its cross-section at an end, m2.
  [[nodiscard]] double cross_section(ColumnFace end = ColumnFace::bottom) const;
  /// Volume below a height over cross_section(), m: the equivalent height in a uniform column. A tapered column
  /// continues above the top with the width of its top.
  [[nodiscard]] double even_height(double height) const;
  /// The inverse of even_height().
  [[nodiscard]] double filled_height(double even) const;
  /// Diameter of a tapered column at a height, m; the smaller one at a step.
  [[nodiscard]] double diameter_at(double height) const;
  /// Least and greatest diameter of a tapered column, and the diameter at an end of a round one, m.
  [[nodiscard]] double narrowest() const;
  [[nodiscard]] double widest() const;
  /// Cross-section at the bottom over the least.
  [[nodiscard]] double contraction() const;
  [[nodiscard]] double diameter_at(ColumnFace end) const;
  /// Mean cross-section between two heights of a round column, m2.
  [[nodiscard]] double area_between(double low, double high) const;
};

/// A fluid whose properties are tabulated, another one, or none.
enum class Substance { none, water, air, other };

struct Fluid {
  std::string name;                   ///< water | air | none, or any name with density and viscosity given
  std::optional<double> temperature;  ///< K
  std::optional<double> density;      ///< kg/m3
  std::optional<double> viscosity;    ///< Pa s
  Compressibility equation_of_state = Compressibility::incompressible;
  double outlet_pressure = 101325;  ///< absolute, at the top of the column, Pa
  double tait_stiffness = 3.0e8;    ///< B of the Tait liquid, Pa

  [[nodiscard]] Substance substance() const;
  [[nodiscard]] bool present() const { return substance() != Substance::none; }
  [[nodiscard]] bool compressible() const { return equation_of_state != Compressibility::incompressible; }
};

/// Sizes of a species by volume, as a case gives them. The resolved case contains the size classes instead.
struct SizeDistribution {
  std::optional<SizeLaw> kind;                    ///< without: one diameter
  std::optional<double> median, mean, deviation;  ///< lognormal: m, m, standard deviation of ln D
  std::vector<std::pair<double, double>> sieves;  ///< (opening m, share retained on it), openings rising
  int classes = 3;
};

inline constexpr double usual_friction = 0.3, usual_restitution = 0.9;

/// Material of walls, and of species that give no other; keys of [dem].
struct Material {
  double friction = usual_friction, restitution = usual_restitution;
  double hamaker_constant = 0;            ///< A, J; 0: unknown
  double roughness = 1e-7;                ///< least thickness of a film between surfaces, m
  std::optional<double> surface_tension;  ///< of a liquid that wets particles in a gas, N/m
  double contact_angle = 0;               ///< of that liquid on particles and walls, degrees
  double liquid_fraction = 0;             ///< volume of that liquid on a particle over the particle's own
};

struct Species {
  std::string name;
  double diameter = 0;  ///< m
  SizeDistribution sizes;
  double density = 0;         ///< kg/m3
  double sphericity = 1;      ///< surface of the sphere of equal volume over its own
  double max_packing = 0.64;  ///< of this species alone
  std::optional<double> youngs_modulus, poisson_ratio, given_friction, given_restitution;  ///< else those of [dem]
  double friction = usual_friction, restitution = usual_restitution;  ///< follow from those given and the material
};

/// The state of the bed at time zero, and the file for a checkpoint or a list of particles.
struct Start {
  StartKind kind = StartKind::mixed;
  std::string file{};
};

/// The word in a case file: "mixed", "list:FILE" ...
[[nodiscard]] std::string text_of(const Start& start);

struct Bed {
  std::vector<double> volume_share;      ///< x_j, sums to 1
  double static_height = 0;              ///< m, of the settled bed
  double solids_fraction = 0;            ///< of the settled bed
  std::optional<double> start_fraction;  ///< as the case gives it
  double start_solids_fraction = 0;      ///< of the starting bed; its mass equals the settled bed's
  std::vector<std::int64_t> particles;   ///< numbers of particles instead of static_height; else empty
  Start start;
  /// Layer of each species for the start "layered" without [[layer]], from the bottom; empty: one layer per species.
  std::vector<std::int64_t> layer;
  std::uint64_t seed = 1;
  double perturbation = 1e-3;  ///< share by which cells of a mixed start differ at random
  bool held = false;           ///< particles do not move: a fixed bed; key of [dem]
};

/// A part of the bed at its start. It lies on the parts before it.
struct Layer {
  std::string species;                    ///< of a layer with one species; resolved to volume_share
  std::vector<double> volume_share;       ///< x_j of its solids, sums to 1
  double height = 0;                      ///< settled, m
  std::optional<double> solids_fraction;  ///< settled; default: as in the bed
  std::vector<double> from, to;           ///< corners of its cross-section, m, as of a feed; empty: the column's
};

struct Inlet {
  /// (time s, superficial velocity m/s): constant before the first and after the last, linear between.
  std::vector<std::pair<double, double>> superficial_velocity;
  /// (time s, volume flow m3/s). resolve() converts it to the superficial velocity and clears it.
  std::vector<std::pair<double, double>> flow_rate;
  ColumnEnd at = ColumnEnd::bottom;  ///< top: the flow is given there too, instead of the pressure
};

/// A part of the bottom with its own velocity, or a part of a side through which fluid enters.
struct Jet {
  std::vector<double> from, to;  ///< its corners, m: see axis_along; on the bottom x, or x and z
  std::vector<std::pair<double, double>> superficial_velocity;  ///< as of the inlet, over the jet's own area
  ColumnFace at = ColumnFace::bottom;                           ///< never the top
};

/// A wall inside the column that particles meet from both sides: flat across the whole depth, or round with the upright
/// axis of the column. It consists of all points within half its thickness of a surface.
struct InnerWall {
  std::vector<double> from, to;  ///< ends of that surface, m: x and y; for a round wall diameter and height
  WallShape shape = WallShape::flat;
  double thickness = 0;  ///< m; a fluid needs one

  /// Whether its profile turns about the axis; a rod is a flat wall of no length.
  [[nodiscard]] bool is_round() const { return shape == WallShape::cylinder || shape == WallShape::cone; }
};

/// The walls of a round column where it is narrower than its widest part, as cones.
[[nodiscard]] std::vector<InnerWall> walls_of_taper(const Column& column);

/// Feed of solids of one species through an end or a side, or through a part of it.
struct Feed {
  std::string species;
  ColumnFace at = ColumnFace::bottom;
  std::vector<std::pair<double, double>>
      superficial_velocity;      ///< solids volume per area and time, m/s, into the column
  double velocity = 0;           ///< of the particles as they enter, m/s
  std::vector<double> from, to;  ///< as of a jet; empty: the whole end or side
};

/// A part of the bottom or a side through which fluid and solids leave in the state next to it.
struct Discharge {
  ColumnFace at = ColumnFace::right;
  std::vector<double> from, to;                                 ///< as of a feed
  std::vector<std::pair<double, double>> superficial_velocity;  ///< of the mixture, out of the column, m/s
  std::optional<double> pressure = {};  ///< outside a side, net: the flow follows from it, instead of the velocity, Pa
};

/// How effects with the word "auto" are chosen, and how neglected effects are monitored.
struct Chooser {
  double tolerance = 0.02;  ///< the neglected effects sum to at most this share
  Purpose purpose = Purpose::steady;
  bool static_heap = false;               ///< the scene studies a heap at rest
  std::optional<double> voidage;          ///< of the bulk; else from the balance of forces
  std::vector<double> velocity_range;     ///< superficial, m/s: widens the range in the case
  std::vector<double> temperature_range;  ///< K
  std::vector<std::string> zones;         ///< packed, bulk, wall, freeboard; empty: all
  MonitorMode monitor = MonitorMode::automatic;
  int monitor_every = 200, monitor_sample = 64;  ///< steps; one in so many particles or cells
  std::vector<std::string> chosen;               ///< the roles that were "auto": a record
};

struct RunPlan {
  double until = 0;  ///< s
};

struct OutputPlan {
  std::optional<double> every;             ///< s, between stored fields; else a twentieth of the run
  std::optional<double> history_every;     ///< s, between rows of history.csv; else a 400th of the run
  std::optional<double> checkpoint_every;  ///< s, between checkpoints; else a tenth of the run in the case
};

/// Discretisation of the fluid equations, in both models; key of [tfm].
struct FluidScheme {
  Momentum momentum = Momentum::automatic;
};

/// A rule, or a number.
using MaxPacking = std::variant<PackingRule, double>;

struct Tfm {
  TfmIntegrator integrator = TfmIntegrator::automatic;
  bool follow_bed = true;
  double rtol = 1e-4;
  PressureForm form = PressureForm::A;
  FractionFlux flux = FractionFlux::limited;
  SolidsWall solids_wall = SolidsWall::free_slip;
  MaxPacking max_packing = PackingRule::automatic;
  double frictional_pressure = 0.05;     ///< Fr of p_f, Pa
  double frictional_onset = 0.5;         ///< solids fraction above which p_f acts
  std::optional<double> bulk_viscosity;  ///< alpha; else 1 over the number of directions with cells
  double viscosity_cap = 10;             ///< greatest frictional viscosity, Pa s
  double least_shear_rate = 1;           ///< gamma_0 of the frictional viscosity, 1/s
  KineticTheory kinetic_theory = KineticTheory::garzo_dufty;
  RadialDistribution radial_distribution = RadialDistribution::torquato;
  double start_temperature = 1e-6;           ///< theta_j at the start where it is transported, m2/s2
  double specularity = 0.1;                  ///< s of Johnson and Jackson's wall
  double wall_friction = 0.2;                ///< tan(delta_w) of Johnson and Jackson's wall
  double exchange_pressure = 0;              ///< C_s of species exchange, s/m2
  std::optional<double> fixed_step;          ///< s: steps of one length, without error control (explicit only)
  std::optional<double> pressure_tolerance;  ///< of the Poisson equation; else min(1e-4, 0.1 rtol)
};

/// Default Young's modulus of slow particles, Pa.
inline constexpr double least_modulus = 5e6;

/// Default limit on the solid steps per fluid step.
inline constexpr int most_fluid_every = 16;

struct Dem {
  double steps_per_contact = 20;
  std::optional<double> youngs_modulus;  ///< Pa; else from the expected speeds, at least least_modulus
  double poisson_ratio = 0.25;
  std::optional<int> fluid_every;  ///< solid steps per fluid step; else from the fluid's velocity, at most 16
  Kernel kernel = Kernel::automatic;
  std::optional<double> kernel_width;  ///< of diffusion, full width at half height, m
  OwnShare own_share = OwnShare::kept;
  FluidRanks fluid_ranks = FluidRanks::automatic;
  Tangential tangential = Tangential::hdd;
  Tail tail = Tail::clip;
  DemIntegrator integrator = DemIntegrator::automatic;
  std::optional<double> normal_stiffness;  ///< k_n of contact = linear, N/m
  double rolling_friction = 0;             ///< mu_r
  double rolling_damping = 0;              ///< share of the critical damping of the rolling spring
  std::optional<double> skin;              ///< reach of the neighbour list beyond contact, m
  double max_overlap = 0.05;               ///< above it the run stops; over the smaller particle's diameter
  std::optional<double> fixed_step;        ///< s
  std::optional<double> greatest_speed;    ///< expected, sets the time step, m/s
  double start_speed = 0;                  ///< rms of each component of random velocities at the start, m/s
  std::optional<double> opening;           ///< of the bottom: width of a slot or a round hole, m; closed without
  bool ledger = true;                      ///< account of the energy
  double cohesion_energy = 0;              ///< W of DMT and JKR, J/m2
  double cohesion_gap = 1.65e-10;          ///< z_0, least gap of the van der Waals force, m
  std::optional<double> asperity_radius;   ///< R* of the van der Waals force, m; else the spheres' own
};

/// The range of superficial velocity in which the two species of the bed change places according to the literature,
/// m/s; one value or two, empty: unknown.
struct Inversion {
  std::vector<double> measured, simulated;
};

/// Boxes of particles that tabulate the solids stress. Empty values have defaults from the plan.
struct Calibrate {
  BoxRegime regime = BoxRegime::automatic;
  std::vector<double> solids_fraction, restitution, friction;  ///< axes
  std::vector<double> stokes;                                  ///< rho d^2 gamma/mu_f, of wet boxes
  std::vector<double> share;                                   ///< of the second species in the solids
  int particles = 1000, seeds = 2, doublings = 2;              ///< of a box; per point; of its length
  double strain = 20, discard_strain = 5;                      ///< averaged, and before that
  double softness = 0.03;                                      ///< t_c over the time between collisions
};

/// Boxes of spheres whose drag polybed resolve computes. The species and their shares are those in the bed.
struct Resolve {
  SphereMotion motion = SphereMotion::held;
  std::vector<double> voidage, reynolds{0};  ///< of the Sauter diameter and the superficial velocity
  int cells_per_diameter = 16;               ///< of the smallest spheres, on the finest grid
  int grids = 2;                             ///< each coarser by 1.5
  int packings = 5, spheres = 50;            ///< per row; in a box
  Precision precision = Precision::one;
  std::optional<double> until;    ///< s, simulated of a box of free spheres
  double checkpoint_every = 600;  ///< s on the clock, between checkpoints of a box
};

struct ContactPair {
  std::vector<std::string> between;  ///< two names of species, or one and "wall"
  std::optional<double> youngs_modulus, poisson_ratio, friction, restitution;
};

/// The classes of a species with a distribution: a record, not read again.
struct SizeClasses {
  std::string species;  ///< as the case names it; the classes are called name.1, name.2, ... from fine to coarse
  SizeDistribution given;
  std::vector<double> diameter, share;  ///< m; of the volume of this distribution
};

/// The word in place of a law with which the chooser decides.
inline constexpr const char* automatic = "auto";

/// Whether a word in [effects] turns the role off; whether it names a law, so does not leave the role to the chooser.
[[nodiscard]] bool is_off(const std::string& law);
[[nodiscard]] inline bool is_law(const std::string& law) { return !is_off(law) && law != automatic; }

/// The entry of a role in [effects].
struct ChosenLaw {
  std::string name = "none";
  bool given = false;                                        ///< whether [effects] contains the role
  [[nodiscard]] bool acts() const { return !is_off(name); }  ///< has a law or is left to the chooser
};

/// Made, copied and destroyed in one source, so that no other source compiles code for its many members.
struct Scene {
  Scene();
  Scene(const Scene& other);
  Scene(Scene&& other) noexcept;
  Scene& operator=(const Scene& other);
  Scene& operator=(Scene&& other) noexcept;
  ~Scene();

  std::string title;
  Column column;
  Fluid fluid;
  FluidScheme scheme;
  Material material;
  std::vector<Species> species;
  Bed bed;
  std::vector<Layer> layers;
  Inlet inlet;
  std::vector<Jet> jets;
  std::vector<Feed> feeds;
  std::vector<Discharge> discharges;
  std::vector<InnerWall> walls;
  std::map<std::string, std::string> effects;  ///< role -> law; a role left out is off
  Chooser chooser;
  RunPlan run;
  OutputPlan output;
  Tfm tfm;
  Dem dem;
  std::vector<ContactPair> contact_pairs;
  Inversion inversion;
  Calibrate calibrate;
  Resolve resolve;
  std::vector<SizeClasses> size_classes;
  /// The content of the drag law's file when the case was read, JSON: a record, not read again; empty without a file.
  std::string drag_record;
  std::vector<std::string> overrides;  ///< "key=value" of the command line, as given
  Places places;                       ///< of the keys and tables of the case: a record, not read again

  [[nodiscard]] bool flows_around() const;  ///< whether a fluid flows through joined ends, without bottom and top
  [[nodiscard]] ChosenLaw law(const std::string& role) const;
  [[nodiscard]] ChosenLaw drag() const { return law("drag"); }
  [[nodiscard]] ChosenLaw partition() const { return law("partition"); }
};

/// The law of a role in [effects]; "none" if the scene names none.
[[nodiscard]] inline std::string law_of(const Scene& scene, const std::string& role) { return scene.law(role).name; }

/// Whether a role has a law or is left to the chooser.
[[nodiscard]] inline bool acts(const Scene& scene, const std::string& role) { return scene.law(role).acts(); }

[[nodiscard]] bool all_spheres(const Scene& scene);  ///< in every species

/// Gives walls and all species one friction, one restitution.
void set_friction(Scene& scene, double friction);
void set_restitution(Scene& scene, double restitution);

/// Fills in friction and restitution of species that do not give them.
void resolve_materials(Scene& scene);

}  // namespace polybed::core
