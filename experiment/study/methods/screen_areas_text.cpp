#include <fmt/format.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

std::string screen_areas_text(const StudyResults& results, const StudyOptions& options) {
    std::string text;
    if (results.screen_area_trials.empty())
        return text;
    std::vector<std::string> names;
    std::vector<int> trials;
    for (const ScreenAreaTrialRow& row : results.screen_area_trials) {
        if (trials.empty() || trials.back() != row.trial)
            trials.push_back(row.trial);
        if (row.area != no_screen_area && std::ranges::find(names, row.area) == names.end())
            names.push_back(row.area);
    }
    constexpr std::size_t most_named = 12;
    const std::string listed =
        names.size() > most_named ? std::string() : fmt::format(" ({})", joined_words(names));
    add_sentence(text, fmt::format("gaze was asked for {} of the screen{}, which {} had",
                                   as_counted(static_cast<int>(names.size()), "area"), listed,
                                   as_counted(static_cast<int>(trials.size()), "trial")));
    std::string rule = "a fixation counted that began after the onset";
    if (options.shortest_fixation_s > 0.0)
        rule += fmt::format(" and lasted {} s or longer", as_set(options.shortest_fixation_s));
    add_sentence(text, rule + "; it lay in an area if the mean of its samples did, while the area was there");
    add_sentence(
        text, "dwell is the time of these fixations, given as a share of the time of all fixations; a visit "
              "is a run of successive fixations in one area; first arrival is the onset of the first "
              "fixation in it, since the onset of the presentation or, without one, since the trial's "
              "begin; a transition is a pair of successive fixations in two areas");
    add_sentence(text,
                 "shares, visits and first arrivals are means over observers of their own means; beside them "
                 "stands the share that gaze spread evenly over the screen and the presentation would have");
    if (results.glance.observers >= 3)
        add_sentence(text, fmt::format("intervals are of {} % and over observers",
                                       as_set(100.0 * options.confidence)));
    return text;
}

} // namespace overt
