#include "experiment/record/preview_file.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace overt {

namespace {

std::string stimulus_file(const SessionHeader& header, const Stimulus& stimulus, std::string_view ending) {
    std::string name =
        fmt::format("stimuli/{}_{}", header.objects[static_cast<std::size_t>(stimulus.object)].id,
                    header.materials[static_cast<std::size_t>(stimulus.material)].id);
    // What else stimuli of the session differ in, by its number.
    constexpr std::pair<std::string_view, int Stimulus::*> further[] = {
        {"light", &Stimulus::light}, {"motion", &Stimulus::motion}, {"view", &Stimulus::view}};
    for (const auto& [word, index] : further) {
        const auto differs = [&, of = index](const RecordedStimulus& other) {
            return other.stimulus.*of != stimulus.*of;
        };
        if (std::ranges::any_of(header.stimuli, differs))
            name += fmt::format("_{}{}", word, stimulus.*index + 1);
    }
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
