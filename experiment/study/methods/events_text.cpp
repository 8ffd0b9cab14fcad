#include <cctype>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

std::string events_text(const StudyResults& results) {
    std::string text;
    add_over_sessions(text, results, [](const StudySession& session) -> std::string {
        std::string clause = session.events;
        if (clause.empty())
            return "there are no fixations, saccades and blinks";
        clause.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(clause.front())));
        return clause;
    });
    return text;
}

} // namespace overt
