#include "experiment/study/methods/methods_text.h"

#include "experiment/study/methods/methods_topics.h"

namespace overt {

std::vector<MethodsParagraph> methods_text(const StudyResults& results, const StudyOptions& options) {
    std::vector<MethodsParagraph> paragraphs;
    const auto add = [&](const char* topic, std::string text) {
        if (!text.empty())
            paragraphs.push_back({topic, std::move(text)});
    };
    add("Observers and trials", observers_text(results, options.exclude));
    add("Apparatus", apparatus_text(results));
    add("Stimuli", stimuli_text(results));
    add("Quality of the gaze data", gaze_quality_text(results));
    add("Fixations, saccades and blinks", events_text(results));
    add("Places on the surface", places_text(results, options));
    add("Areas of the screen", screen_areas_text(results, options));
    add("Answers", answers_text(results, options));
    add("Analysis", statistics_text(results, options));
    return paragraphs;
}

} // namespace overt
