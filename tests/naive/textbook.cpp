// The textbook treatments of this program: linked in the place of the product's answer, which is none.
#include "multiscale/stability/textbook.hpp"

#include "naive/treatments.hpp"

namespace polybed {

namespace {

class Treatments final : public stability::Textbook {
 public:
  [[nodiscard]] std::unique_ptr<stability::Run> run(const std::string& name, const core::Scene& scene,
                                                    core::Timers& timers,
                                                    const std::function<void(tfm::Model&)>& start) const override {
    return naive::make_run(name, scene, timers, start);
  }
};

}  // namespace

const stability::Textbook* stability::textbook() {
  static const Treatments treatments;
  return &treatments;
}

}  // namespace polybed
