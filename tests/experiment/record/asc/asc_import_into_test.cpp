#include <sstream>

#include <catch2/catch.hpp>

#include "experiment/record/asc/asc_export.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/verify/verification.h"
#include "tests/experiment/record/eye_session.h"
#include "tests/support/asc_text.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

AscImportOptions into_options(const fs::path& out) {
    AscImportOptions options;
    options.place = {out.parent_path() / "sessions", "imported", "07"};
    options.out = out;
    return options;
}

} // namespace

TEST_CASE("a copy with gaze lies where the pattern of its experiment's sessions does not find it", "[unit]") {
    const test::TemporaryFolder root;
    const fs::path session = make_eye_session(root.path() / "sessions");
    export_asc(SessionRecord(session), root.path() / "asc");
    const fs::path file =
        write_asc(root.path() / "tracker.asc", text_of(root.path() / "asc" / "sub-AB7_ses-01_run-01.asc"));
    AscImportOptions options = into_options({});
    options.out.clear();
    const AscImportSummary summary = import_asc_into(file, session / "", options);
    const fs::path folder = session.parent_path();
    CHECK(summary.session ==
          folder.parent_path() / (folder.filename().string() + "_imports") / session.filename());
    CHECK(SessionRecord(summary.session).gaze_source(1));
    // As a shell's sessions/NAME/*.
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder))
        if (!entry.path().filename().string().starts_with("."))
            found.push_back(entry.path());
    CHECK(found == std::vector<fs::path>{session});
}

TEST_CASE("the gaze of a file comes into the trials that its messages name, in a copy of the session",
          "[unit]") {
    const test::TemporaryFolder root;
    const fs::path session = make_eye_session(root.path());
    const SessionRecord original(session);
    const std::string before = text_of(session / session_file_name);
    export_asc(original, root.path() / "asc");

    const std::string text = text_of(root.path() / "asc" / "sub-AB7_ses-01_run-01.asc");
    const fs::path file = write_asc(root.path() / "tracker.asc", text);

    const AscImportSummary summary = import_asc_into(file, session, into_options(root.path() / "with_gaze"));
    CHECK(summary.trials == 3);
    CHECK(text_of(session / session_file_name) == before);
    const SessionRecord record(root.path() / "with_gaze");
    CHECK(fs::exists(root.path() / "with_gaze" / "stimuli" / "bust_gold.png"));
    REQUIRE(record.trials().size() == original.trials().size());
    for (std::size_t i = 0; i < record.trials().size(); ++i) {
        const auto samples = record.samples(record.trials()[i]),
                   originals = original.samples(original.trials()[i]);
        REQUIRE(samples.size() == originals.size());
        const bool is_new = record.trials()[i].sitting == 1;
        REQUIRE((samples[0].sampled_at == originals[0].sampled_at) == !is_new);
        REQUIRE(samples[0].gaze->x_px == Approx(originals[0].gaze->x_px).margin(1e-3));
        CHECK(record.trials()[i].outcome.answer == original.trials()[i].outcome.answer);
    }
    CHECK(record.clock_pairs(1).size() == original.clock_pairs(1).size());
    CHECK(record.gaze_source(1)->file == "tracker.asc");
    CHECK_FALSE(record.gaze_source(2));
    CHECK(record.damages().empty());
    CHECK(verify_session(record.directory()).is_sound());
    CHECK_THROWS_WITH(import_asc_into(file, session, into_options(root.path() / "with_gaze")),
                      Contains("exists already"));
}

TEST_CASE("where the tracker's clock was never read, the messages of the screens relate it to the session's",
          "[unit]") {
    const test::TemporaryFolder root;
    const fs::path session = make_eye_session(root.path());
    export_asc(SessionRecord(session), root.path() / "asc");
    // The same recording by a clock that shows 1000 s less.
    std::string shifted;
    for (const std::string& line : [&] {
             std::istringstream text(text_of(root.path() / "asc" / "sub-AB7_ses-01_run-01.asc"));
             std::vector<std::string> lines;
             for (std::string one; std::getline(text, one);)
                 lines.push_back(one);
             return lines;
         }()) {
        const std::size_t begin = line.find_first_of("0123456789");
        const bool has_time = line.starts_with("MSG\t") || line.starts_with("START\t") ||
                              line.starts_with("END\t") || begin == 0;
        const std::size_t end = has_time ? line.find_first_not_of("0123456789", begin) : 0;
        shifted += has_time ? line.substr(0, begin) +
                                  std::to_string(std::stoll(line.substr(begin, end - begin)) - 1'000'000) +
                                  line.substr(end)
                            : line;
        shifted += '\n';
    }
    import_asc_into(write_asc(root.path() / "other.asc", shifted), session,
                    into_options(root.path() / "with_gaze"));
    const SessionRecord record(root.path() / "with_gaze");
    const auto map = record.clock_map(1);
    REQUIRE(map);
    // Samples began 900 ms after the trial, at tracker time 7000 s + 10.9 s by the old clock.
    const TrackerTime first = record.samples(record.trials()[0])[0].sampled_at;
    const MappedTime mapped = map->to_session(first);
    CHECK(std::abs(to_seconds(mapped.time) - 10.9) < 2e-3);
    CHECK(mapped.uncertainty > std::chrono::microseconds(500));

    // Without those messages nothing relates them.
    std::string silent = shifted;
    for (const char* word : {"TASK_SCREEN_ONSET", "PRESENTATION_ONSET", "PRESENTATION_OFFSET",
                             "RESPONSE_SCREEN_ONSET", "RESPONSE\n"})
        for (std::size_t at = silent.find(word); at != std::string::npos; at = silent.find(word))
            silent.replace(at, 4, "none");
    CHECK_THROWS_WITH(import_asc_into(write_asc(root.path() / "silent.asc", silent), session,
                                      into_options(root.path() / "silent")),
                      Contains("nothing relates"));
    CHECK_FALSE(fs::exists(root.path() / "silent"));
    CHECK_THROWS_WITH(
        import_asc_into(write_asc(root.path() / "alien.asc", "START\t1 \tLEFT\n1\t1.0\t1.0\t1.0\t...\n"),
                        session, into_options(root.path() / "silent")),
        Contains("no message TRIALID"));
}
