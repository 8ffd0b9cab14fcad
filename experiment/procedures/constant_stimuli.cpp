#include "experiment/procedures/constant_stimuli.h"

#include <span>

#include "experiment/base/random.h"

namespace overt {

ConstantStimuli::ConstantStimuli(const ConstantStimuliSettings& settings) : missed_(settings.missed) {
    for (int repetition = 0; repetition < settings.repetitions; ++repetition) {
        std::vector<double> once = settings.levels;
        RandomStream(settings.seed, "constant stimuli", static_cast<std::uint64_t>(repetition))
            .shuffle(std::span(once));
        order_.insert(order_.end(), once.begin(), once.end());
    }
}

std::optional<double> ConstantStimuli::next() const {
    return at_ < order_.size() ? std::optional(order_[at_]) : std::nullopt;
}

void ConstantStimuli::tell(double, TrackAnswer answer) {
    if (at_ >= order_.size())
        return;
    if (answer == TrackAnswer::missed && missed_ == UnansweredTrial::repeat) {
        order_.push_back(order_[at_]);
    } else {
        ++trials_;
    }
    ++at_;
}

TrackState ConstantStimuli::state() const {
    TrackState state;
    state.trials = trials_;
    return state;
}

} // namespace overt
