/// Sessions with all that belongs to them, closed or cut off, and their bytes turned over.
#pragma once

#include <csignal>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <thread>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiment/base/random.h"
#include "experiment/record/manifest.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/missed_rows.h"

namespace overt::testing {

inline const SessionManifest::Program test_program{"overt", "0.1.0", std::string(64, '5')};

/// A published session with a protocol, a mesh and a map, and its manifest.
inline std::filesystem::path make_whole_session(const std::filesystem::path& root) {
    const SessionHeader header = example_header();
    SessionDirectory directory({root, header.protocol.name, header.schedule.observer.label});
    for (const char* const file : {"protocol.toml", "meshes/bust.ply", "maps/bust_02.exr", "stimuli/a.png"}) {
        std::filesystem::create_directories((directory.path() / file).parent_path());
        std::ofstream(directory.path() / file) << "what is in " << file << std::string(300, 'x');
    }
    create_session_file(directory.session_file(), header);
    begin_manifest(directory.path(), header, test_program);
    directory.publish();
    return directory.path();
}

inline GazeSample some_sample(int number) {
    GazeSample sample;
    sample.sampled_at = TrackerTime(std::chrono::microseconds(9'000'000'000'000 + 500 * number));
    if (number % 5 != 0)
        sample.gaze = ScreenPoint{0.1 * number, -1.0 / (1 + number)};
    sample.pupil_area = 0.3f * static_cast<float>(number);
    return sample;
}

inline void write_rows(SessionStore& store, const Trial& trial, int samples) {
    store.trial_started(trial, at_ms(trial.index * 10000));
    store.event({at_ms(trial.index * 10000 + 1), trial.index, "drift check", "0.4 deg"});
    for (int i = 0; i < samples; ++i) {
        store.sample(trial.index, some_sample(i));
        if (i % 10 == 0) {
            FlipRecord flip{trial.index, i / 10, {0}, {1}, {2}, {}};
            flip.report.vertical_blank = at_ms(trial.index * 10000 + i);
            store.flip(flip);
        }
    }
    store.missed({trial.index, samples, {7}, {2}, {1}, {0}, at_ms(5), SessionDuration(9)});
}

/// Three trials and their manifest.
inline void write_whole_session(const std::filesystem::path& session) {
    SessionStore store(session / session_file_name, patient());
    store.display_box({});
    for (int trial = 0; trial < 3; ++trial) {
        write_rows(store, example_header().schedule.trials[static_cast<std::size_t>(trial)], 400 + trial);
        store.trial_finished(example_header().schedule.trials[static_cast<std::size_t>(trial)],
                             outcome_at(trial * 10000));
        store.clock_pair({at_ms(1), TrackerTime(std::chrono::microseconds(77)), at_ms(2)});
    }
    store.event({at_ms(40000), -1, "session completed", ""});
    store.close();
    REQUIRE(close_manifest(session));
}

/// Two trials and a third that a kill cuts off, with its rows in the log.
inline void write_killed_session(const std::filesystem::path& session) {
    const pid_t child = ::fork();
    if (child == 0) {
        const std::filesystem::path file = session / session_file_name, log = file.string() + "-wal";
        const auto wait_until = [](const auto& condition) {
            while (!condition())
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
        };
        SessionStore store(file, patient());
        const SessionHeader header = example_header();
        // Calibrations come at any time, and each is rows of two tables.
        RecordedCalibration calibration;
        calibration.method = "tracker";
        calibration.validation.targets.resize(9);
        store.calibration(calibration);
        for (std::size_t trial = 0; trial < 2; ++trial) {
            write_rows(store, header.schedule.trials[trial], 400);
            store.trial_finished(header.schedule.trials[trial], outcome_at(static_cast<int>(trial) * 10000));
        }
        // A reader before that would keep what the log has of earlier trials in it.
        wait_until([&] { return std::filesystem::file_size(log) == 0; });
        store.calibration(calibration);
        write_rows(store, header.schedule.trials[2], 300);
        wait_until([&] {
            const SessionRecord record(session);
            return record.trials().size() == 3 &&
                   test::missed_rows(session, record.trials()[2].id).size() == 1;
        });
        ::raise(SIGKILL);
    }
    ::waitpid(child, nullptr, 0);
}

/// Turns one bit of a file over, and back in the end.
class FlippedBit {
  public:
    FlippedBit(std::filesystem::path file, std::uint64_t byte, int bit)
        : file_(std::move(file)), byte_(byte), bit_(bit) {
        turn();
    }
    ~FlippedBit() { turn(); }
    FlippedBit(const FlippedBit&) = delete;
    FlippedBit& operator=(const FlippedBit&) = delete;

  private:
    void turn() const {
        std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekg(static_cast<std::streamoff>(byte_));
        const char now = static_cast<char>(stream.get() ^ (1 << bit_));
        stream.seekp(static_cast<std::streamoff>(byte_));
        stream.put(now);
    }
    std::filesystem::path file_;
    std::uint64_t byte_;
    int bit_;
};

/// All rows as any reader gets them: of each table and trial (0: of none) the rows as text. Nothing if not
/// all can be read.
using AllRows = std::map<std::pair<std::string, std::int64_t>, std::vector<std::string>>;
inline std::optional<AllRows> read_all_rows(const std::filesystem::path& session_file) {
    try {
        AllRows all;
        SQLite::Database database(session_file.string(), SQLite::OPEN_READONLY);
        std::vector<std::string> tables;
        SQLite::Statement names(database, "SELECT name FROM sqlite_schema WHERE type = 'table'");
        while (names.executeStep())
            tables.push_back(names.getColumn(0).getString());
        for (const std::string& table : tables) {
            SQLite::Statement rows(database, "SELECT * FROM " + table);
            while (rows.executeStep()) {
                std::string text;
                std::int64_t trial = 0;
                for (int column = 0; column < rows.getColumnCount(); ++column) {
                    if (table != "seal" && std::string(rows.getColumnName(column)) == "trial_id")
                        trial = rows.getColumn(column).getInt64();
                    text += std::to_string(rows.getColumn(column).getType()) + ":" +
                            rows.getColumn(column).getString() + "|";
                }
                all[{table, trial}].push_back(text);
            }
        }
        return all;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

/// The tables and trials whose rows differ.
inline std::set<std::pair<std::string, std::int64_t>> differing(const AllRows& a, const AllRows& b) {
    std::set<std::pair<std::string, std::int64_t>> places;
    for (const auto& [place, rows] : a)
        if (!b.contains(place) || b.at(place) != rows)
            places.insert(place);
    for (const auto& [place, rows] : b)
        if (!a.contains(place))
            places.insert(place);
    return places;
}

} // namespace overt::testing
