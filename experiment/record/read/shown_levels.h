/// Which stimulus a slot showed at each flip, where a match set it.
#pragma once

#include <map>

#include "experiment/record/read/session_record.h"

namespace overt {

class ShownLevels {
  public:
    /// Of a presentation (TrialRecord::seen_in). Throws RecordError.
    ShownLevels(const SessionRecord& record, const TrialRecord& seen);

    /// The stimulus that a flip lit, by its refresh; where no match set it, that of the trial.
    const Stimulus& at(RefreshIndex refresh) const;

  private:
    Stimulus own_;
    std::map<std::int64_t, Stimulus> set_; ///< by refresh of the display
};

} // namespace overt
