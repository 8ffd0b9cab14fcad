#include "experiment/record/bids/bids_names.h"

#include <cctype>

#include <fmt/format.h>

namespace overt {

bool was_recorded_elsewhere(const SessionHeader& header) { return header.stimuli.empty(); }

std::string bids_task_name(const SessionHeader& header) {
    return header.protocol.title.empty() || was_recorded_elsewhere(header) ? header.protocol.name
                                                                           : header.protocol.title;
}

BidsNames::BidsNames(const SessionHeader& header)
    : subject(header.schedule.observer.label), session(fmt::format("{:02}", header.session_number)) {
    for (const char c : header.protocol.name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            task += c;
    if (task.empty())
        task = "unnamed";
}

std::filesystem::path BidsNames::folder() const {
    return std::filesystem::path("sub-" + subject) / ("ses-" + session) / "beh";
}

std::string BidsNames::task_stem() const {
    return fmt::format("sub-{}_ses-{}_task-{}_", subject, session, task);
}

std::string BidsNames::run_stem(int run) const { return fmt::format("{}run-{:02}", task_stem(), run); }

std::string BidsNames::surface_run_stem(int run) const {
    return fmt::format("{}acq-surface_run-{:02}", task_stem(), run);
}

std::string BidsNames::surface_stem(int run, int eye) const {
    return fmt::format("{}_recording-eye{}", surface_run_stem(run), eye);
}

std::string BidsNames::eye_stem(int run, int eye) const {
    return fmt::format("{}_recording-eye{}", run_stem(run), eye);
}

} // namespace overt
