#include "experiment/record/verify/log_check.h"

#include <catch2/catch.hpp>

#include "experiment/record/verify/verification.h"
#include "tests/experiment/record/sealed_session.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Kind = LogFinding::Kind;

namespace {

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const fs::path& file, std::string_view bytes) {
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// The log of a session that was killed in its third trial, and where its frames are.
struct KilledSession {
    TemporaryFolder root;
    fs::path folder = make_whole_session(root.path());
    fs::path log = folder / (std::string(session_file_name) + "-wal");
    std::string bytes;
    std::size_t frame_bytes = 0, frames = 0;
    std::vector<bool> is_commit; ///< by frame, from 0

    KilledSession() {
        write_killed_session(folder);
        bytes = bytes_of(log);
        frame_bytes = 24 + (static_cast<std::size_t>(static_cast<unsigned char>(bytes[10])) << 8);
        frames = (bytes.size() - 32) / frame_bytes;
        for (std::size_t frame = 0; frame < frames; ++frame)
            is_commit.push_back(bytes.substr(begin_of(frame) + 4, 4) != std::string(4, '\0'));
    }
    std::size_t begin_of(std::size_t frame) const { return 32 + frame * frame_bytes; }
    std::size_t frame_at(std::size_t byte) const { return (byte - 32) / frame_bytes; }
    std::optional<Kind> kind_of(const std::string& log_bytes) const {
        write_bytes(log, log_bytes);
        const auto found = look_through_log(log);
        return found ? std::optional(found->kind) : std::nullopt;
    }
    /// Rows of a table that the record has with this log.
    std::int64_t samples_with(const std::string& log_bytes) const {
        write_bytes(log, log_bytes);
        SQLite::Database database((folder / session_file_name).string(), SQLite::OPEN_READONLY);
        return database.execAndGet("SELECT COUNT(*) FROM sample").getInt64();
    }
};

} // namespace

TEST_CASE("a log that ends anywhere is cut off, and never damaged", "[unit]") {
    const KilledSession session;
    REQUIRE(session.frames > 4);
    CHECK_FALSE(session.kind_of(session.bytes));
    RandomStream random(3, "lengths");
    for (int round = 0; round < 100; ++round) {
        const std::size_t length = random.below(static_cast<std::uint32_t>(session.bytes.size()));
        const bool is_whole = length == 0 || (length >= 32 && (length - 32) % session.frame_bytes == 0);
        CAPTURE(length, session.frame_bytes);
        CHECK(session.kind_of(session.bytes.substr(0, length)) ==
              (is_whole ? std::nullopt : std::optional(Kind::cut_off)));
    }
}

TEST_CASE("zeros to the log's end are what a failure of power leaves, zeros before whole frames are damage",
          "[unit]") {
    const KilledSession session;
    RandomStream random(4, "holes");
    for (int round = 0; round < 100; ++round) {
        std::string bytes = session.bytes;
        // The last sector at least.
        const std::size_t from = 32 + random.below(static_cast<std::uint32_t>(bytes.size() - 32 - 512));
        std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end(), '\0');
        CAPTURE(from);
        CHECK(session.kind_of(bytes) == Kind::cut_off);
    }
    // Within a frame's own header, too: a sector's border can lie there.
    for (std::size_t byte = 0; byte <= 24; ++byte) {
        std::string bytes = session.bytes;
        const std::size_t from = session.begin_of(session.frames - 2) + byte;
        std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end(), '\0');
        CAPTURE(byte);
        CHECK(session.kind_of(bytes) == Kind::cut_off);
    }
    // What is not of the tail.
    std::string bytes = session.bytes;
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(session.begin_of(1)), session.frame_bytes, '\0');
    CHECK(session.kind_of(bytes) == Kind::damaged);
}

TEST_CASE("frames without their commit did not count: a fault in them is no damage, and what counted is read",
          "[unit]") {
    const KilledSession session;
    // The log as it is when the program is killed before the last frame of a transaction.
    std::size_t cut = 0;
    for (std::size_t frame = 1; frame < session.frames; ++frame)
        if (session.is_commit[frame] && !session.is_commit[frame - 1])
            cut = frame;
    REQUIRE(cut > 0);
    std::size_t first = cut;
    while (first > 0 && !session.is_commit[first - 1])
        --first;
    const std::string bytes = session.bytes.substr(0, session.begin_of(cut));
    CHECK_FALSE(session.kind_of(bytes));
    const std::int64_t samples = session.samples_with(session.bytes.substr(0, session.begin_of(first)));
    RandomStream random(5, "flips");
    for (int round = 0; round < 50; ++round) {
        std::string flipped = bytes;
        const std::size_t frame = first + random.below(static_cast<std::uint32_t>(cut - first));
        const std::size_t byte =
            session.begin_of(frame) + 24 + random.below(static_cast<std::uint32_t>(session.frame_bytes - 24));
        flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << random.below(8)));
        CAPTURE(byte, frame);
        CHECK(session.kind_of(flipped) == Kind::cut_off);
        CHECK(session.samples_with(flipped) == samples);
    }
}

TEST_CASE("one bit turned over in what was committed is damage, and the frame is named", "[unit]") {
    const KilledSession session;
    RandomStream random(6, "flips");
    for (int round = 0; round < 300; ++round) {
        std::string bytes = session.bytes;
        const std::size_t byte = 32 + random.below(static_cast<std::uint32_t>(bytes.size() - 32));
        bytes[byte] = static_cast<char>(bytes[byte] ^ (1 << random.below(8)));
        CAPTURE(byte);
        write_bytes(session.log, bytes);
        const auto found = look_through_log(session.log);
        REQUIRE(found);
        CHECK(found->kind == Kind::damaged);
        CHECK_THAT(found->what, Contains("frame " + std::to_string(session.frame_at(byte) + 1) + " of"));
    }
}

TEST_CASE("a session whose log was cut off is sound, says so, and is gone on with", "[unit]") {
    const KilledSession session;
    std::string bytes = session.bytes;
    std::fill(bytes.end() - static_cast<std::ptrdiff_t>(session.frame_bytes + 700), bytes.end(), '\0');
    write_bytes(session.log, bytes);
    const Verification found = verify_session(session.folder);
    CHECK(found.is_sound());
    REQUIRE_FALSE(found.notes.empty());
    CHECK_THAT(found.notes[0], Contains("session.sqlite-wal: is cut off at frame"));
    {
        SessionStore store(session.folder / session_file_name, patient());
        store.close();
    }
    REQUIRE(close_manifest(session.folder));
    const Verification resumed = verify_session(session.folder);
    CHECK(resumed.is_sound());
    CHECK(resumed.state == Verification::State::closed);
    CHECK(resumed.notes.empty());
}
