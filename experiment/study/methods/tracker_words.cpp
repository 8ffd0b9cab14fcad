#include "experiment/study/methods/tracker_words.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace overt {

namespace {

/// Drivers that are called by their interface.
constexpr std::pair<std::string_view, std::string_view> known_names[] = {
    {"eyelink", "EyeLink"},
    {"tobii", "Tobii"},
    {"Open Gaze", "Gazepoint through the Open Gaze API"},
    {"hid", "HID eye tracker"},
    {"Lab Streaming Layer", "stream of the Lab Streaming Layer"}};

std::string name_and_model(const GazeSetup& gaze) {
    std::string_view name = gaze.tracker;
    for (const auto& [driver, known_as] : known_names)
        if (name == driver)
            name = known_as;
    if (name.empty())
        return gaze.model.empty() ? "of unknown make" : gaze.model;
    return gaze.model.empty() ? std::string(name) : fmt::format("{} ({})", name, gaze.model);
}

} // namespace

std::string tracker_words(const GazeSetup& gaze) {
    switch (gaze.origin) {
    case GazeOrigin::measured:
        return name_and_model(gaze);
    case GazeOrigin::imported:
        return gaze.was_simulated ? "none: imported was simulated gaze" : name_and_model(gaze);
    case GazeOrigin::simulated:
        return "none: gaze was simulated";
    case GazeOrigin::played_back:
        return gaze.model.empty() ? "none: gaze was played back from a recording"
                                  : fmt::format("none: played back was the {}", gaze.model);
    case GazeOrigin::pointer:
        return "none: the mouse pointer stood in for an eye";
    case GazeOrigin::none:
        return "none: gaze was not recorded";
    }
    return {};
}

std::string eyes_words(const GazeSetup& gaze) {
    const std::string one = gaze.eye == Eye::left ? "left" : "right";
    return gaze.both_eyes ? fmt::format("both eyes, of which the {} is analysed", one)
                          : fmt::format("the {} eye", one);
}

} // namespace overt
