/// Shards of a study: what is written comes back to the bit, and only shards that belong together are joined.
#include "experiment/study/read/study_shard.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using test::TemporaryFolder;

namespace {

ReadSession read_session(const std::string& path, int trials) {
    ReadSession session{path, "as it was", "Found from the samples.", {}};
    for (int t = 0; t < trials; ++t) {
        ReadTrial& trial = session.trials.emplace_back();
        trial.samples = 16000 + t;
        trial.had_both_eyes = t == 1;
        trial.trial.label = "observer 07, trial 3";
        trial.trial.keys = {{"task", "free"}, {"material", "größer"}};
        trial.trial.presentation_s = 0.1 + 0.2;
        trial.trial.turns = {{0.033, -25.0 / 3.0, 7}};
        trial.trial.quality.accuracy_deg = std::nextafter(0.3, 1.0);
        trial.trial.quality.blinks = 2;
        StudyFixation& fixation = trial.fixations.emplace_back();
        fixation.onset_s = -0.0;
        fixation.why = NotCounted::not_on_surface;
        fixation.position = {1.0 / 3.0, 1e-300, -2.0};
        fixation.triangle = 4000000000u;
        fixation.part = PartIndex{1};
        fixation.gaze_with_surface_deg2 = 0.7;
        fixation.light = {1.0 / 3.0, -0.0, 2.0};
        fixation.lut_mm = 1e-9;
        trial.trace.points = {{0.5, ScreenPoint{3.0, 4.0}, 2.5f}, {0.6, std::nullopt, 0.0f}};
        trial.trace.events = {{GazeEvent::Kind::blink, 0.6, 0.1}};
    }
    return session;
}

/// Five sessions, read by two machines.
StudyShard shard(int number, const StudyOptions& options = {}) {
    StudyShard made{number, 2, {"/a", "/b", "/c", "/d", "/e"}, reading_parameters(options), {}};
    for (std::size_t i = static_cast<std::size_t>(number) - 1; i < made.sessions.size(); i += 2)
        made.read.push_back(read_session(made.sessions[i], 2));
    return made;
}

std::string refusal(std::vector<StudyShard> shards, const StudyOptions& options = {}) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < shards.size(); ++i)
        names.push_back(fmt::format("shards/{}", i + 1));
    try {
        joined_shards(std::move(shards), names, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "joined";
}

} // namespace

TEST_CASE("a shard comes back from its file to the bit", "[unit]") {
    const TemporaryFolder folder, again;
    CHECK_FALSE(is_shard(folder.path()));
    write_shard(folder.path(), shard(1));
    REQUIRE(is_shard(folder.path()));
    const StudyShard read = read_shard(folder.path());
    REQUIRE(read.read.size() == 3);
    const ReadTrial& trial = read.read[2].trials[1];
    CHECK(read.read[2].session == "/e");
    CHECK(trial.samples == 16001);
    CHECK(trial.had_both_eyes);
    CHECK(trial.trial.keys[1].value == "größer");
    CHECK(trial.trial.presentation_s == 0.1 + 0.2);
    CHECK(*trial.trial.quality.accuracy_deg == std::nextafter(0.3, 1.0));
    CHECK_FALSE(trial.trial.quality.sd_deg);
    CHECK(std::signbit(trial.fixations[0].onset_s));
    REQUIRE(trial.fixations[0].light);
    CHECK(trial.fixations[0].light->met == 1.0 / 3.0);
    CHECK(std::signbit(trial.fixations[0].light->at_place));
    CHECK(trial.fixations[0].position.y == 1e-300);
    CHECK(trial.fixations[0].triangle == 4000000000u);
    CHECK(trial.fixations[0].gaze_with_surface_deg2 == 0.7);
    CHECK(trial.trace.points[0].gaze == ScreenPoint{3.0, 4.0});
    CHECK_FALSE(trial.trace.points[1].gaze);
    write_shard(again.path(), read);
    CHECK(read_whole_file(again.path() / shard_file_name) ==
          read_whole_file(folder.path() / shard_file_name));
}

TEST_CASE("a shard that is cut off, changed or of another kind is refused", "[unit]") {
    const TemporaryFolder folder;
    write_shard(folder.path(), shard(2));
    const std::string whole = read_whole_file(folder.path() / shard_file_name);
    for (const std::size_t length : {whole.size() - 1, whole.size() / 2, std::size_t{40}}) {
        folder.file(shard_file_name, whole.substr(0, length));
        CHECK_THROWS_AS(read_shard(folder.path()), RecordError);
    }
    std::string changed = whole;
    changed[whole.size() / 2] = static_cast<char>(changed[whole.size() / 2] + 1);
    folder.file(shard_file_name, changed);
    CHECK_THROWS_WITH(read_shard(folder.path()), Catch::Contains("damaged: make it again"));
    std::string newer = whole;
    newer[newer.find("version ") + 8] = '9';
    folder.file(shard_file_name, newer);
    CHECK_THROWS_WITH(read_shard(folder.path()), Catch::Contains("another version"));
    folder.file(shard_file_name, "something else");
    CHECK_THROWS_WITH(read_shard(folder.path()), Catch::Contains("no shard of a study"));
}

TEST_CASE("a shard that was forged with its hash has no words that there are not", "[unit]") {
    const TemporaryFolder folder;
    write_shard(folder.path(), shard(2));
    const std::string whole = read_whole_file(folder.path() / shard_file_name);
    const std::size_t first = whole.find('\n') + 1, hash = whole.size() - hash_of_text("").size();
    int refused = 0;
    for (std::size_t at = first; at < hash; ++at) {
        std::string forged = whole.substr(0, hash);
        forged[at] = static_cast<char>(0xee);
        folder.file(shard_file_name, forged + hash_of_text(forged));
        StudyShard read;
        try {
            read = read_shard(folder.path());
        } catch (const Error&) {
            ++refused;
            continue;
        }
        for (const ReadSession& session : read.read)
            for (const ReadTrial& trial : session.trials) {
                for (const StudyFixation& fixation : trial.fixations)
                    REQUIRE(fixation.why <= NotCounted::no_stimulus);
                for (const StudyTraceEvent& event : trial.trace.events)
                    REQUIRE(event.kind <= GazeEvent::Kind::blink);
            }
    }
    CHECK(refused > 0);
}

TEST_CASE("shards are joined in the order of the study, in whatever order they are given", "[unit]") {
    for (const bool turned : {false, true}) {
        std::vector<StudyShard> shards{shard(turned ? 2 : 1), shard(turned ? 1 : 2)};
        const std::vector<ReadSession> joined = joined_shards(std::move(shards), {"one", "other"}, {});
        REQUIRE(joined.size() == 5);
        for (std::size_t i = 0; i < 5; ++i)
            CHECK(joined[i].session == std::string{'/', static_cast<char>('a' + i)});
    }
}

TEST_CASE("shards that do not make a study are refused in words", "[unit]") {
    CHECK(refusal({shard(1)}) == "a shard is missing: shard 2/2. Give all of them.");
    CHECK(refusal({shard(1), shard(2), shard(1)}) ==
          "shards/1 and shards/3 are both shard 1/2: its sessions would count twice.");
    StudyShard foreign = shard(2);
    foreign.sessions[1] = "/another";
    CHECK(refusal({shard(1), foreign}).find("the session /another is in one where the other has /b") !=
          std::string::npos);
    foreign.sessions = {"/a"};
    CHECK(refusal({shard(1), foreign}).find("is in one where the other has /b") != std::string::npos);
    StudyShard of_three = shard(2);
    of_three.count = 3;
    CHECK(refusal({shard(1), of_three}).find("shards/2 is one of 3 shards, and shards/1 one of 2") == 0);
    StudyOptions wider;
    wider.sigma = {30.0, true};
    CHECK(refusal({shard(1), shard(2)}, wider) == "shards/1 was read with --sigma 1deg, and here stands "
                                                  "--sigma 30mm: give the same, or make the shards "
                                                  "again.");
    StudyOptions narrower;
    narrower.sigma = {0.5, false};
    CHECK(refusal({shard(1), shard(2)}, narrower) == "shards/1 was read with --sigma 1deg, and here stands "
                                                     "--sigma 0.5deg: give the same, or make the shards "
                                                     "again.");
    StudyOptions in_mm;
    in_mm.sigma = {1.0, true};
    CHECK(refusal({shard(1), shard(2)}, in_mm).find("--sigma 1deg, and here stands --sigma 1mm") !=
          std::string::npos);
    StudyOptions other_seed;
    other_seed.seed = 7;
    other_seed.by = {"material"};
    CHECK(refusal({shard(1), shard(2)}, other_seed) == "joined");
}
