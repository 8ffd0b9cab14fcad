/// Reads where on objects the answers of kind "point" lie.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "experiment/study/read/open_sessions.h"
#include "experiment/study/results/point_rows.h"

namespace overt {

/// Is shown the presentations of a study object by object; an answer belongs to the presentation in whose
/// picture it lies, and one beside all of them to the trial's first. One thread.
class PointReader {
  public:
    /// The answers of a trial that gives results, in this presentation of it. `session`, `observer` and
    /// `object`: of the study. `lookup`: of the object; null: no surface. Throws RecordError.
    void read(const OpenSession& open, int session, const std::string& observer, const TrialRecord& trial,
              int object, const SurfaceLookup* lookup);

    /// All so far, in the order of sessions, trials and answers.
    std::vector<AnsweredPointRow> rows() const;

  private:
    struct Read {
        AnsweredPointRow row;
        bool is_in_picture = false;
        int place = 0; ///< of the presentation in its trial
    };
    std::map<std::tuple<int, int, std::size_t>, Read> answers_; ///< by session, trial and answer
};

} // namespace overt
