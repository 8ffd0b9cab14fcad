/// How a simulated observer turns an object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "experiment/ports/observer_input.h"
#include "experiment/ports/turning_offer.h"
#include "experiment/trial.h"

namespace overt {

/// One turn after the other: by a normal angle, at the speed of the keys, then a pause, log-normal with a
/// standard deviation of half a unit of the logarithm. With keys where there are some, else by dragging with
/// the mouse, which moves sixty times a second. A function of the seed, the trial, the show and the place.
class SimulatedTurns {
  public:
    void clear() noexcept;
    /// Adds the turns of one object.
    void plan(std::uint64_t seed, const Trial& trial, const TurningOffer& offer);
    /// What is due, in the order of time; allocates and throws nothing.
    std::optional<ObserverInput> next(SessionTime now) noexcept;

  private:
    std::vector<ObserverInput> planned_;
    std::size_t next_ = 0;
};

} // namespace overt
