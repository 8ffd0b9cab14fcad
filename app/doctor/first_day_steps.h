/// The steps of a lab's first day: what each needs, and what it measures.
#pragma once

#include <span>
#include <string_view>

#include "app/display/display_commands.h"
#include "app/doctor/first_day.h"
#include "app/rig/rig_page.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// What the steps are measured with.
struct FirstDay {
    const FirstDayOptions& options;
    const Protocol& protocol;     ///< with the tracker that the options name
    std::filesystem::path folder; ///< of the rig's pages
    const RigPage& page;          ///< what was found so far

    bool is_headless() const;             ///< no screen is taken: a display that only keeps time stands in
    DoctorOptions doctor_options() const; ///< for the doctor's measurements of screen and light
};

struct FirstDayStep {
    std::string_view name;  ///< as --step has it
    std::string_view title; ///< what it is about, as the page has it
    std::string_view needs; ///< what the technician sets up before, in sentences
    int minutes = 1;        ///< that it takes, about
    /// The facts of facts_of_protocol() that it depends on, between commas.
    std::string_view depends_on;
    /// Gives verdict, finding, remedy and figures, and facts that only open devices tell. What it throws
    /// becomes a verdict, too: see first_day.cpp.
    RigStep (*measure)(const FirstDay& day) = nullptr;
};

/// In the order of the day.
std::span<const FirstDayStep> first_day_steps();

/// What the light's step finds, and the boxes' step goes by.
inline constexpr std::string_view mean_light_figure = "from vertical blank to light, mean";

// One each, in the file of their devices.
RigStep measure_bytes(const FirstDay& day);
RigStep measure_refreshes(const FirstDay& day);
RigStep measure_light_latency(const FirstDay& day);
RigStep measure_gaze_stream(const FirstDay& day);
RigStep measure_accuracy(const FirstDay& day);
RigStep measure_clock(const FirstDay& day);
RigStep measure_response_boxes(const FirstDay& day);
RigStep measure_markers(const FirstDay& day);
RigStep measure_trials(const FirstDay& day);

/// A step that nothing could be measured in.
RigStep not_proved(std::string finding, std::string remedy);
/// Proved if all figures hold, else failed; `remedy` is of the latter.
RigStep judged(BenchFigures figures, std::string finding, std::string remedy);
/// What a simulated device proves is the program alone. `what` was simulated: "the light sensor".
RigStep as_simulated(RigStep step, std::string_view what);

} // namespace overt
