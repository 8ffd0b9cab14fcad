/// A small session for tests of its record and its exports.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "experiment/record/header_rows.h"
#include "experiment/record/session_directory.h"
#include "experiment/record/write/session_store.h"
#include "tests/support/temporary_folder.h"

namespace overt::testing {

using test::TemporaryFolder;

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Two objects, two materials, two tasks, four trials; every field has a value of its own.
inline SessionHeader example_header() {
    SessionHeader header;
    header.protocol = {"tiny", "A tiny protocol", "name = \"tiny\" # ü\n",
                       hash_of_text("name = \"tiny\" # ü\n")};
    header.schedule.observer = {"AB7", 7};
    header.schedule.seed = 0xfedcba9876543210u;
    header.schedule.trials = {{0, 1, {0, 1}}, {1, 0, {1, 0}}, {2, 0, {0, 0}}, {3, 1, {1, 1}}};
    header.session_number = 3;
    header.started_utc = "2024-02-29T23:59:59Z";
    header.clock = ClockKind::virtual_time;
    header.program = {"0.1.0", "GNU 12.2.0", "-O3", "0123abc"};
    header.graphics = {"osmesa", "Mesa", "llvmpipe", "3.3"};
    header.tracker = {"simulated", 2000.0, Eye::left};
    ScreenGeometry screen;
    screen.screen_px = {800, 600};
    screen.screen_mm = {400.5, 300.25};
    screen.viewing_distance_mm = 571.0;
    screen.image_origin_px = {144, 44};
    screen.image_px = {512, 511};
    header.display = {screen, 100.0, std::chrono::microseconds(1500), "mono++", 0.125};
    Animation& motion = header.animations.front();
    motion.frame_count = 3;
    motion.frame_rate_hz = 25.0;
    motion.amplitude = Degrees{12.5};
    motion.playback = Playback::ping_pong;
    motion.duration_s = 2.52;
    header.poses = {{{{-12.5}}, {{0.1}}, {{12.5}}}, {{PoseIndex{0}, PoseIndex{1}, PoseIndex{2}}}};
    header.tasks = {{"free", "Look around"}, {"age", "How old?\tSay it."}};
    RecordedObject bust{"bust",
                        "A bust",
                        std::string(64, 'a'),
                        "meshes/bust.ply",
                        {"body", "head"},
                        {Camera{{1.0, -200.5, 3.0}, {0.25, 0.5, 0.75}, Degrees{11.5}}},
                        {1.5, 2.5, 3.5},
                        {{-1.0, -2.0, -3.0}, {4.0, 5.0, 6.0}}};
    RecordedObject vase{"vase", "A vase", std::string(64, 'b'), "meshes/vase.ply", {"body"}, {Camera{}},
                        {},     {}};
    header.objects = {bust, vase};
    header.materials = {{"gold", "Gold"}, {"silver", "Silver"}};
    header.stimuli = {{{0, 0}, "rendered", std::string(64, 'c'), std::string(64, 'f'), "llvmpipe"},
                      {{1, 1}, "given: a/##.exr", ""}};
    header.maps = {{{0},
                    {2},
                    "maps/bust_02.exr",
                    std::string(64, 'd'),
                    RecordedMap::Made::prepared,
                    RecordedMap::Kind::coordinates},
                   {{1}, {0}, "maps/vase_00.exr", std::string(64, 'e'), RecordedMap::Made::live}};
    return header;
}

/// Makes a published session with this header and gives its directory.
inline std::filesystem::path make_session(const std::filesystem::path& root, const SessionHeader& header) {
    SessionDirectory directory({root, header.protocol.name, header.schedule.observer.label});
    create_session_file(directory.session_file(), header);
    directory.publish();
    return directory.path();
}

inline SessionStore::Options patient() {
    SessionStore::Options options;
    options.wait_when_full = true;
    options.started_utc = "2024-03-01T00:00:00Z";
    return options;
}

constexpr SessionTime at_ms(std::int64_t milliseconds) {
    return SessionTime(std::chrono::milliseconds(milliseconds));
}

inline TrialOutcome outcome_at(std::int64_t start_ms) {
    TrialOutcome outcome;
    outcome.task_screen_onset = at_ms(start_ms + 10);
    outcome.presentation_onset = at_ms(start_ms + 1000);
    outcome.presentation_end = at_ms(start_ms + 3000);
    outcome.response_screen_onset = at_ms(start_ms + 3010);
    outcome.responded_at = at_ms(start_ms + 4000);
    outcome.shown_refreshes = 200;
    outcome.missed_refreshes = 1;
    outcome.swaps = SwapModes{.flipped = 195, .copied = 3, .suboptimal_copied = 2, .skipped = 1};
    outcome.drift = Degrees{0.5};
    outcome.answer = "forty\tor\nfifty";
    return outcome;
}

} // namespace overt::testing
