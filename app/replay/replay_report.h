/// What came out of presenting a session again, in words and for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/replay/export_comparison.h"
#include "experiment/record/verify/record_comparison.h"

namespace overt {

struct ReplayReport {
    std::string session;
    std::string recorded_by, replayed_by; ///< versions of the program
    bool is_presented_again = false;      ///< else remade from the recorded flips and gaze
    std::string why_not;                  ///< then
    std::vector<std::string> compared;    ///< what came out the same, or did not, a line each
    std::vector<std::string> not_compared;
    std::vector<RecordDifference> differences; ///< the first of each table, in the order of the session
    std::vector<FileDifference> files;         ///< of the folder and of the exports
    bool is_same() const { return differences.empty() && files.empty(); }
};

/// Of stimuli of whose frames the record, or the replay, does not know the pixels.
std::string pixels_not_known(std::int64_t stimuli);

/// The first difference first.
std::string to_text(const ReplayReport& report);
nlohmann::ordered_json to_json(const ReplayReport& report);

} // namespace overt
