/// The records of a session's further eye trackers.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <vector>

#include "app/rig/rig.h"
#include "app/session/resumed_session.h"
#include "app/session/session_circumstances.h"
#include "experiment/record/session_directory.h"
#include "experiment/record/write/session_store.h"
#include "experiment/session/session_ports.h"
#include "experiment/session/shared_log.h"

namespace overt {

/// The header of a further tracker's record.
SessionHeader header_of_further(SessionHeader session, const Rig::Further& further);

/// Main thread. Closed by end(); else as a session that was killed.
class FurtherRecords {
  public:
    /// What differs between the sittings of the session and of a further tracker's record.
    using OptionsOf = std::function<SessionStore::Options(const Protocol& protocol, const EyeTracker& tracker,
                                                          const std::optional<Resumption>& resumption)>;

    /// Opens the records that lie in the session's directory: one for each further tracker of the rig.
    /// `resumed`: null for a session that was just begun. Throws RecordError.
    FurtherRecords(Rig& rig, const std::filesystem::path& session, const ResumedSession* resumed,
                   const OptionsOf& options_of);

    std::vector<FurtherTracker> ports();
    /// Adds all of them to what an event of the session is recorded in.
    void join(SharedLog& log);
    /// A map that was written into the session's directory.
    void add_map(const RecordedMap& map);

    LostRows lost() const;
    /// Fetches the trackers' files, and closes the records. False: a manifest is not finished, for another
    /// program has the record open. Throws RecordError.
    bool end();
    /// Fetches the trackers' files alone, of a session that has failed.
    void rescue_files();

  private:
    struct Record {
        Record(Rig::Further& further, std::filesystem::path in, const SessionStore::Options& options);
        Rig::Further& of;
        std::filesystem::path folder;
        SessionStore store;
        RecordedTracker tracker() { return {of.id, of.protocol.tracker, *of.tracker, folder, store}; }
    };
    Rig& rig_;
    std::filesystem::path session_;
    std::deque<Record> records_;
};

} // namespace overt
