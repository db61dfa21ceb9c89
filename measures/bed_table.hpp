// The measures of a bed: one table for both models, finished runs and studies.
#pragma once

#include "measures/profile.hpp"
#include "measures/table.hpp"

namespace polybed::measures {

/// Share of all solids below which a species is what rounding leaves of one that has left.
inline constexpr double trace = 1e-9;

/// A bed at one time.
struct Bed {
  Profile profile = {};
  // Known only to a run.
  double time = 0, step = 0;      ///< s
  double buoyant_weight = 0;      ///< Pa
  std::vector<double> mass = {};  ///< kg, [species]
  // More exact values from a run of particles; empty: computed from the profile.
  Value pressure_drop = {};        ///< Pa
  std::vector<Value> centre = {};  ///< m, [species]
};

/// Each row becomes a measure everywhere. The columns of history.csv follow this order.
/// \param around  the ends of the column are joined: what is read along the height, from a bottom, has no value
[[nodiscard]] Table<Bed> bed_table(bool around = false);

/// A profile next to another one on the same slabs.
struct Beside {
  const Profile &profile, &reference;
};

[[nodiscard]] Table<Beside> distance_table();

/// history.csv of either model: measures of the bed, then the model's own.
template <class Own>
class History {
 public:
  History(const Table<Bed>& bed, const Table<Own>& own, const std::vector<std::string>& species)
      : bed_(singles(read_by(&Readers::history, bed), species)), own_(singles(own, species)) {}

  [[nodiscard]] std::vector<std::string> columns() const {
    std::vector<std::string> found;
    for (const Single<Bed>& measure : bed_) found.push_back(measure.column());
    for (const Single<Own>& measure : own_) found.push_back(measure.column());
    return found;
  }
  [[nodiscard]] std::vector<Value> row(const Bed& bed, const Own& own) const {
    std::vector<Value> found = values(bed_, bed), rest = values(own_, own);
    found.insert(found.end(), rest.begin(), rest.end());
    return found;
  }

 private:
  std::vector<Single<Bed>> bed_;
  std::vector<Single<Own>> own_;
};

}  // namespace polybed::measures
