// The measures of a bed: one table for both models, for finished runs and for studies.
#pragma once

#include "measures/profile.hpp"
#include "measures/table.hpp"

namespace polybed::measures {

/// A bed at one time.
struct Bed {
  Profile profile = {};
  // What a run alone knows.
  double time = 0, step = 0;      ///< s
  double buoyant_weight = 0;      ///< Pa
  std::vector<double> mass = {};  ///< kg, [species]
  // What a run of particles knows better than by its profile; empty: by the profile.
  Value pressure_drop = {};        ///< Pa
  std::vector<Value> centre = {};  ///< m, [species]
};

/// A row here is a measure everywhere. History.csv has the rows in this order.
[[nodiscard]] Table<Bed> bed_table();

/// A profile beside another one on the same slabs.
struct Beside {
  const Profile &profile, &reference;
};

[[nodiscard]] Table<Beside> distance_table();

/// history.csv of either model: what is read off the bed, then what the model alone knows.
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
