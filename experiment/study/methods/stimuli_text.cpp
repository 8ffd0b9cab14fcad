#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

namespace {

/// "3 objects (a, b and c)".
std::string named_things(const std::vector<NamedThing>& things, std::string_view one) {
    std::vector<std::string> names;
    for (const NamedThing& thing : things)
        names.push_back(thing.title.empty() ? thing.id : thing.title);
    return fmt::format("{} ({})", as_counted(things.size(), one), joined_words(names));
}

std::string motion_clause(const StudySession& session) {
    const StimulusSetup& stimuli = session.setup.stimuli;
    if (stimuli.frame_count == 0)
        return {};
    std::string clause = fmt::format("pictures had {} x {} pixels", stimuli.image_px.x, stimuli.image_px.y);
    if (stimuli.image_deg)
        clause += fmt::format(" or {} x {} deg", as_measured(stimuli.image_deg->x, 1),
                              as_measured(stimuli.image_deg->y, 1));
    if (!stimuli.motions.empty())
        return fmt::format("{}; in each presentation, as it was planned, {}", clause,
                           fmt::join(stimuli.motions, "; or "));
    const std::string duration = fmt::format("for {} s", as_set(stimuli.duration_s));
    if (stimuli.frame_count == 1 || stimuli.amplitude_deg == 0.0)
        return fmt::format("{}, and were planned to be shown {}, without motion", clause, duration);
    return fmt::format(
        "{}; in each presentation, planned {}, the object turned to and fro about the vertical, as a sine of "
        "time, by {} deg to each side, in {} frames of {} at {} Hz",
        clause, duration, as_set(stimuli.amplitude_deg), stimuli.frame_count,
        stimuli.playback == Playback::ping_pong ? "one sweep" : "one period", as_set(stimuli.frame_rate_hz));
}

std::string questions_clause(const std::vector<NamedThing>& tasks) {
    std::vector<std::string> questions;
    for (const NamedThing& task : tasks)
        if (!task.title.empty())
            questions.push_back(fmt::format("\"{}\"", task.title));
    if (questions.empty())
        return "what observers were asked is not on record";
    return fmt::format(
        "before a presentation observers read {}{}",
        questions.size() == 1 ? "" : fmt::format("one of {} questions or instructions: ", questions.size()),
        joined_words(questions));
}

} // namespace

std::string stimuli_text(const StudyResults& results) {
    std::string text;
    const std::vector<NamedThing> objects = objects_shown(results), materials = materials_shown(results);
    const auto unknown = static_cast<int>(std::ranges::count_if(
        results.sessions, [](const StudySession& one) { return one.setup.stimuli.frame_count == 0; }));
    if (!objects.empty())
        add_sentence(text,
                     fmt::format("{} {} shown{}", named_things(objects, "object"),
                                 objects.size() == 1 ? "was" : "were",
                                 materials.empty() ? "" : ", in " + named_things(materials, "material")));
    if (unknown > 0)
        add_sentence(text, fmt::format("what was shown {}is not on record",
                                       unknown == results.glance.sessions
                                           ? ""
                                           : fmt::format("in {} ", share_of(unknown, results.glance.sessions,
                                                                            "session"))));
    add_over_sessions(text, results, motion_clause);
    if (const auto spread = spread_over_trials(results, trial_measure(TrialMeasureOf::presentation)))
        add_sentence(text, fmt::format("presentations lasted {}", as_spread(*spread, "s", 3)));
    if (!objects.empty())
        add_sentence(text, questions_clause(tasks_asked(results)));
    return text;
}

} // namespace overt
