/// One sitting of a session presented again, and its record held against the recorded one.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "app/cli/context_choice.h"
#include "app/inputs/protocol_inputs.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/verify/record_comparison.h"

namespace overt {

/// How many sittings a session has.
int sittings_of(const SessionRecord& record);

/// Why a sitting cannot be presented again so that all of it comes out the same, as the rest of a sentence;
/// empty if it can.
std::string why_not_again(const SessionRecord& record, int sitting);

/// Where a sitting breaks off in the record, and in words why; nothing of one that ended by itself, or by a
/// key that stands in the record.
struct SittingCut {
    RecordCut cut;
    std::string why;
};
std::optional<SittingCut> cut_of(const SessionRecord& record, int sitting);

struct SittingReplay {
    RecordComparison comparison;
    std::map<std::string, RecordComparison> further; ///< of further eye trackers' records, by id
    std::optional<SittingCut> cut;
    std::filesystem::path recorded_file; ///< a copy: the session file as this sitting left it
    std::filesystem::path folder;        ///< the session as it was presented again
};

struct SittingRequest {
    const SessionRecord& record;
    int sitting;
    const Experiment& experiment;
    std::filesystem::path protocol; ///< where its file lies or would lie
    std::filesystem::path cache;    ///< of frames; maps are drawn anew
    ContextChoice context;
    std::filesystem::path work; ///< a folder of its own, which stays as long as what is given is read
    std::function<void(int done, int all)> progress; ///< after each attempt
};

/// Presents it in virtual time. Throws what a session throws, and Error if it is interrupted.
SittingReplay replay_sitting(const SittingRequest& request);

} // namespace overt
