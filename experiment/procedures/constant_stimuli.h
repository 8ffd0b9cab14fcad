/// Constant stimuli: each level as often as the others, in an order that is drawn.
#pragma once

#include <vector>

#include "experiment/procedures/level_track.h"

namespace overt {

struct ConstantStimuliSettings {
    std::vector<double> levels; ///< each once
    int repetitions = 10;
    UnansweredTrial missed = UnansweredTrial::repeat; ///< a level that comes again does so at the end
    std::uint64_t seed = 1;
};

class ConstantStimuli : public LevelTrack {
  public:
    /// The order is drawn repetition by repetition: all levels come once before one comes a second time.
    explicit ConstantStimuli(const ConstantStimuliSettings& settings);

    std::optional<double> next() const override;
    void tell(double shown, TrackAnswer answer) override;
    TrackState state() const override;

  private:
    std::vector<double> order_;
    std::size_t at_ = 0;
    UnansweredTrial missed_;
    int trials_ = 0;
};

} // namespace overt
