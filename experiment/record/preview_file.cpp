#include "experiment/record/preview_file.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

std::string preview_file(const SessionHeader& header, const Condition& condition) {
    return fmt::format("stimuli/{}_{}.png",
                       header.sculptures[static_cast<std::size_t>(condition.sculpture)].id,
                       header.materials[static_cast<std::size_t>(condition.material)].id);
}

const RecordedStimulus* stimulus_of(const SessionHeader& header, const Condition& condition) {
    const auto found =
        std::find_if(header.stimuli.begin(), header.stimuli.end(),
                     [&](const RecordedStimulus& stimulus) { return stimulus.condition == condition; });
    return found == header.stimuli.end() ? nullptr : &*found;
}

} // namespace overt
