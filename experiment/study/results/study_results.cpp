#include "experiment/study/results/study_results.h"

#include <algorithm>

namespace overt {

bool knows_stimuli(const StudyResults& results) {
    const auto knows_none = [](const StudySession& session) {
        return session.setup.gaze.origin == GazeOrigin::imported && session.setup.stimuli.frame_count == 0;
    };
    return results.sessions.empty() || !std::ranges::all_of(results.sessions, knows_none);
}

std::optional<double> rate_too_low_for_counts(const StudyResults& results) {
    std::optional<double> least;
    for (std::size_t i = 0; i < results.sessions.size(); ++i) {
        std::optional<double> rate;
        if (i < results.session_quality.size())
            rate = results.session_quality[i].rate_hz;
        if (!rate && results.sessions[i].setup.gaze.rate_hz > 0.0)
            rate = results.sessions[i].setup.gaze.rate_hz;
        if (rate && *rate < least_rate_for_counts_hz)
            least = std::min(least.value_or(*rate), *rate);
    }
    return least;
}

std::string_view name_of(NotCounted why) {
    switch (why) {
    case NotCounted::counted:
        return "counted";
    case NotCounted::began_before_onset:
        return "began before onset";
    case NotCounted::too_short:
        return "too short";
    case NotCounted::no_frame_lit:
        return "no frame lit";
    case NotCounted::not_on_surface:
        return "not on the surface";
    case NotCounted::no_surface:
        return "no maps of the surface";
    case NotCounted::trial_excluded:
        return "trial excluded";
    case NotCounted::no_stimulus:
        return "no stimulus known";
    }
    return "";
}

std::string_view name_of(MapWeighting weighting) {
    return weighting == MapWeighting::duration ? "duration" : "count";
}

std::string_view name_of(MapPredictor predictor) {
    switch (predictor) {
    case MapPredictor::same_level:
        return "same level";
    case MapPredictor::other_level:
        return "other level";
    case MapPredictor::exposure:
        return "exposure";
    case MapPredictor::model:
        return "model";
    }
    return "";
}

const std::string& StudyTrial::key(const std::string& column) const {
    static const std::string nothing = "n/a";
    const auto found =
        std::find_if(keys.begin(), keys.end(), [&](const StudyKey& key) { return key.column == column; });
    return found == keys.end() ? nothing : found->value;
}

} // namespace overt
