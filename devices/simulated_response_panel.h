/// The key and the voice of a simulated observer.
#pragma once

#include <optional>
#include <string>

#include "devices/simulated_observer.h"
#include "experiment/ports.h"

namespace overt {

/// Presses «next» when the observer has read or answered, and again each second for as long as that has no
/// effect (a protocol may set a least time).
class SimulatedResponsePanel final : public ResponsePanel {
  public:
    /// Both must outlive this.
    SimulatedResponsePanel(const Clock& clock, const SimulatedObserver& observer)
        : clock_(&clock), observer_(&observer) {}

    void await_key(SessionTime since) override;
    void await_response(const Trial& trial, SessionTime since) override;
    std::optional<ResponsePress> poll() noexcept override;
    std::string answer() override { return answer_; }

  private:
    const Clock* clock_;
    const SimulatedObserver* observer_;
    int texts_read_ = 0;
    std::optional<SessionTime> next_press_;
    std::string answer_;
};

} // namespace overt
