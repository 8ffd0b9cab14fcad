#include "app/record/chosen_presentation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"

namespace overt {

TrialRecord chosen_presentation(const SessionRecord& record, const TrialRecord& trial,
                                const std::string& slot) {
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < trial.trial.shown_count(); ++i) {
        ids.push_back(record.header().slots[static_cast<std::size_t>(trial.trial.shown(i).slot)].id);
        if (slot.empty() || ids.back() == slot)
            return trial.seen_in(i);
    }
    throw InputError(fmt::format("--slot {}: trial {} shows nothing there, but in {}", slot,
                                 trial.trial.index + 1, fmt::join(ids, ", ")));
}

} // namespace overt
