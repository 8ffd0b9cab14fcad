/// The sessions of a study, open for reading.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/study/read/trial_keys.h"
#include "experiment/study/read/trial_reader.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// A session with as many readers as may work on it at once.
struct OpenSession {
    std::filesystem::path path; ///< absolute
    std::vector<std::unique_ptr<SessionRecord>> readers;
    std::vector<std::unique_ptr<TrialKeys>> keys; ///< by reader
    std::vector<RecordedAccuracy> validations;    ///< in the order of time
    std::map<ViewedObject, int> objects;          ///< of the study, by the session's own indices
    std::vector<TrialRecord> presentations;       ///< of its record: the units of a study
    const SessionRecord& record() const { return *readers.front(); }
    bool is_one_of_many = false; ///< too many for all of them to keep their files open
    /// To be called when its readers have done a piece of work: one of many lets go of its files until the
    /// next.
    void rest() const {
        for (const std::unique_ptr<SessionRecord>& reader : readers)
            if (is_one_of_many)
                reader->rest();
    }
};

/// Each with so many readers that all of them together keep the processors busy. `detect_events`: as in
/// StudyOptions. Throws InputError if a folder is no session, or if any session is given twice: by its path,
/// as a copy, which its record tells, or as two imports of one recording; RecordError for a damaged one.
std::vector<OpenSession> open_sessions(std::span<const std::filesystem::path> sessions,
                                       const std::optional<ChosenThresholds>& detect_events);

/// What the study says of a session that was named by `path`; of its events, see
/// SessionRecord::event_origins().
StudySession describe_session(const OpenSession& open, const std::filesystem::path& path);

/// Whether two sessions' objects in a view, by their indices there, are one: the same picture of the same
/// mesh.
bool is_same_object(const SessionHeader& a, const ViewedObject& in_a, const SessionHeader& b,
                    const ViewedObject& in_b);

/// What a study knows of a session's object in a view, by its indices there, without its mesh. Where the
/// session has several views, its title has the view's.
StudyObject describe_object(const SessionHeader& header, const ViewedObject& viewed);

/// How far a session has got: another text once it was gone on with.
std::string state_of(const SessionRecord& record);

} // namespace overt
