/// What many trials and many sessions ask of a reader.
#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/experiment/record/sealed_session.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

/// Descriptors of this process that lead into a folder.
int descriptors_into(const fs::path& folder) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
        std::error_code gone;
        count += fs::read_symlink(entry.path(), gone).string().starts_with(folder.string());
    }
    return count;
}

} // namespace

TEST_CASE("a sitting's clock map is made once, however many trials ask for it", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_whole_session(session);
    const SessionRecord record(session);
    const auto before = record.clock_map(1).value().to_session(TrackerTime(std::chrono::microseconds(77)));
    {
        // Who asks again is told the same: nothing is read.
        SQLite::Database database((session / session_file_name).string(), SQLite::OPEN_READWRITE);
        database.exec("UPDATE clock_pair SET before_ns = before_ns + 5000000, after_ns = after_ns + 5000000");
    }
    CHECK(record.clock_map(1).value().to_session(TrackerTime(std::chrono::microseconds(77))).time ==
          before.time);
    CHECK(SessionRecord(session)
              .clock_map(1)
              .value()
              .to_session(TrackerTime(std::chrono::microseconds(77)))
              .time == before.time + std::chrono::milliseconds(5));
    CHECK_FALSE(record.clock_map(2));
}

TEST_CASE("a session that rests holds no descriptor, and is read on when it is asked", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_whole_session(session);
    const SessionRecord record(session);
    CHECK(descriptors_into(session) > 0);
    const std::size_t samples = record.samples(record.trials()[1]).size();
    record.rest();
    CHECK(descriptors_into(session) == 0);
    CHECK(record.header().protocol.name == "tiny");
    CHECK(descriptors_into(session) == 0);
    CHECK(record.samples(record.trials()[1]).size() == samples);
    CHECK(descriptors_into(session) > 0);
}
