#include "experiment/record/preview_file.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace overt {

namespace {

std::string stimulus_file(const SessionHeader& header, const Stimulus& stimulus, std::string_view ending) {
    std::string name = fmt::format("stimuli/{}", stimulus_name(header, stimulus, "_"));
    return name += ending;
}

} // namespace

std::string preview_file(const SessionHeader& header, const Stimulus& stimulus) {
    return stimulus_file(header, stimulus, ".png");
}

std::string light_file(const SessionHeader& header, const Stimulus& stimulus) {
    return stimulus_file(header, stimulus, "_light.exr");
}

const RecordedStimulus* stimulus_of(const SessionHeader& header, const Stimulus& stimulus) {
    const auto found =
        std::find_if(header.stimuli.begin(), header.stimuli.end(),
                     [&](const RecordedStimulus& recorded) { return recorded.stimulus == stimulus; });
    return found == header.stimuli.end() ? nullptr : &*found;
}

} // namespace overt
