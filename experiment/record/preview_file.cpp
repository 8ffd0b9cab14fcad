#include "experiment/record/preview_file.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

namespace {

std::string stimulus_file(const SessionHeader& header, const Condition& condition, std::string_view ending) {
    return fmt::format("stimuli/{}_{}{}", header.objects[static_cast<std::size_t>(condition.object)].id,
                       header.materials[static_cast<std::size_t>(condition.material)].id, ending);
}

} // namespace

std::string preview_file(const SessionHeader& header, const Condition& condition) {
    return stimulus_file(header, condition, ".png");
}

std::string light_file(const SessionHeader& header, const Condition& condition) {
    return stimulus_file(header, condition, "_light.exr");
}

const RecordedStimulus* stimulus_of(const SessionHeader& header, const Condition& condition) {
    const auto found =
        std::find_if(header.stimuli.begin(), header.stimuli.end(),
                     [&](const RecordedStimulus& stimulus) { return stimulus.condition == condition; });
    return found == header.stimuli.end() ? nullptr : &*found;
}

} // namespace overt
