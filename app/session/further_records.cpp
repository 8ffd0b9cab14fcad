#include "app/session/further_records.h"

#include "app/cli/this_program.h"
#include "app/session/session_recording.h"
#include "experiment/record/manifest.h"
#include "experiment/record/session_schema.h"

namespace overt {

SessionHeader header_of_further(SessionHeader session, const Rig::Further& further) {
    session.tracker = further.tracker->description();
    session.further_tracker = further.id;
    return session;
}

FurtherRecords::Record::Record(Rig::Further& further, std::filesystem::path in,
                               const SessionStore::Options& options)
    : of(further), folder(std::move(in)), store(folder / session_file_name, options) {}

FurtherRecords::FurtherRecords(Rig& rig, const std::filesystem::path& session, const ResumedSession* resumed,
                               const OptionsOf& options_of)
    : rig_(rig), session_(session) {
    for (Rig::Further& further : rig.further_trackers()) {
        const std::filesystem::path folder = further_record(session, further.id);
        std::optional<Resumption> resumption;
        if (resumed) {
            resumption = resumption_of_further(*resumed, folder);
            reopen_manifest(folder, header_of_further(resumed->header, further), this_program());
        }
        records_.emplace_back(further, folder, options_of(further.protocol, *further.tracker, resumption));
        note_tracker(records_.back().tracker(), rig.clock());
    }
}

std::vector<FurtherTracker> FurtherRecords::ports() {
    std::vector<FurtherTracker> ports;
    for (Record& record : records_)
        ports.push_back({record.of.id, *record.of.tracker, record.store});
    return ports;
}

void FurtherRecords::join(SharedLog& log) {
    for (Record& record : records_)
        log.add(record.store);
}

void FurtherRecords::add_map(const RecordedMap& map) {
    for (Record& record : records_) {
        share_file(session_, record.folder, map.file);
        record.store.map_made(map);
    }
}

LostRows FurtherRecords::lost() const {
    LostRows lost;
    for (const Record& record : records_)
        lost += record.store.lost();
    return lost;
}

bool FurtherRecords::end() {
    bool is_finished = true;
    for (Record& record : records_) {
        end_tracker(record.tracker(), rig_.clock());
        record.store.close();
        is_finished = close_manifest(record.folder) && is_finished;
    }
    return is_finished;
}

void FurtherRecords::rescue_files() {
    for (Record& record : records_)
        rescue_tracker_file(record.tracker());
}

} // namespace overt
