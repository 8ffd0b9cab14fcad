#include <fmt/format.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

namespace {

std::string reach_clause(const std::optional<double>& reach_deg) {
    if (!reach_deg)
        return "a sample that missed the object by no more than the mean error of the validation before the "
               "trial was given the nearest place of its outline";
    if (*reach_deg == 0.0)
        return "a sample that missed the object had no place on it";
    return fmt::format(
        "a sample that missed the object by no more than {} deg was given the nearest place of "
        "its outline",
        as_set(*reach_deg));
}

/// "5 that began before the onset".
std::string not_counted_words(NotCounted why, int count) {
    const std::string number = as_count(count);
    switch (why) {
    case NotCounted::counted:
        return number;
    case NotCounted::began_before_onset:
        return number + " that began before the onset";
    case NotCounted::too_short:
        return number + (count == 1 ? " that was too short" : " that were too short");
    case NotCounted::no_frame_lit:
        return number + " during which no picture was lit";
    case NotCounted::not_on_surface:
        return number + (count == 1 ? " with too few samples on the object"
                                    : " with too few samples each on the object");
    case NotCounted::no_surface:
        return number + " for which there is no map of a surface";
    case NotCounted::no_stimulus:
        return number + " in trials whose stimulus is not on record";
    case NotCounted::trial_excluded:
        return number + " of excluded trials";
    }
    return {};
}

bool any_placed(const StudyResults& results) {
    return std::ranges::any_of(results.objects, [](const StudyObject& one) { return one.mesh != nullptr; });
}

void add_counts(std::string& text, const StudyResults& results) {
    const StudyGlance& glance = results.glance;
    if (glance.fixations == 0) {
        add_sentence(text, "there are no fixations");
        return;
    }
    std::vector<std::string> reasons;
    for (const auto& [why, count] : glance.not_counted)
        reasons.push_back(not_counted_words(why, count));
    if (glance.counted == 0)
        add_sentence(text, fmt::format("none of {} was counted: {} were left out",
                                       as_counted(glance.fixations, "fixation"), joined_words(reasons)));
    else
        add_sentence(text,
                     fmt::format("{} {} counted", share_of(glance.counted, glance.fixations, "fixation"),
                                 glance.counted == 1 ? "was" : "were"));
    if (glance.counted > 0 && !reasons.empty())
        add_sentence(text, fmt::format("left out were {}", joined_words(reasons)));
    if (glance.only_by_reach > 0)
        add_sentence(text, fmt::format("{} counted only by samples that were given a place of the outline",
                                       share_of(glance.only_by_reach, glance.counted, "counted fixation")));
}

/// How places on several objects became places on one.
void add_template(std::string& text, const StudyResults& results, const StudyOptions& options) {
    std::vector<std::string> thin_plates, similarities;
    for (const TemplateFitRow& fit : results.template_fits) {
        if (fit.landmarks == 0)
            continue;
        (fit.warp == "similarity" ? similarities : thin_plates)
            .push_back(fmt::format("{} ({})", results.objects[static_cast<std::size_t>(fit.object)].id,
                                   as_counted(fit.landmarks, "landmark")));
    }
    const auto say = [&](const std::vector<std::string>& objects, const char* how) {
        if (!objects.empty())
            add_sentence(text,
                         fmt::format("places on {} were brought to the surface of {} by {}, and then to "
                                     "the nearest place there that belongs to the same named areas",
                                     joined_words(objects), options.onto.object, how));
    };
    say(thin_plates, "a thin-plate spline in space (Bookstein 1989)");
    say(similarities, "a similarity of least squares (Umeyama 1991)");
}

} // namespace

std::string places_text(const StudyResults& results, const StudyOptions& options) {
    std::string text;
    if (!knows_stimuli(results)) {
        add_sentence(
            text,
            "what was shown is not on record, so that no fixation was placed on a surface, and no maps, "
            "shares of parts or comparisons of conditions on a surface were computed");
        add_sentence(text, fmt::format("{} have their places on the screen",
                                       as_counted(results.glance.fixations, "fixation")));
        return text;
    }
    if (!any_placed(results)) {
        add_sentence(text, "the sessions have no surfaces, so that no fixation was placed on one");
        add_counts(text, results);
        return text;
    }
    add_sentence(text,
                 "each sample within a fixation was assigned to the picture that was lit at its time on "
                 "its row of the display, and to the point where its line of sight meets the object in "
                 "the pose of that picture");
    add_sentence(text, reach_clause(options.reach_deg));
    add_sentence(
        text, "the place of a fixation is that of the sample nearest to the median of its samples' places");
    std::string rule = "a fixation was counted if it began after the onset of its presentation";
    if (options.shortest_fixation_s > 0.0)
        rule += fmt::format(", lasted {} s or longer,", as_set(options.shortest_fixation_s));
    add_sentence(text, fmt::format("{} and if {} % of its samples or more had a place", rule,
                                   as_set(100.0 * options.least_on_surface)));
    add_counts(text, results);
    add_template(text, results, options);
    return text;
}

} // namespace overt
