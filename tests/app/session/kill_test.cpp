/// Killed at any instant, a session goes on and ends as planned.
#include "experiment/base/random.h"
#include "experiment/record/manifest.h"
#include "tests/app/session/interrupted_run.h"
#include <random>

using namespace overt;
using namespace overt::test;
namespace fs = std::filesystem;
using Clock_ = std::chrono::steady_clock;

namespace {

/// When to kill.
enum class Moment { any_time, in_the_session, making_the_folder, closing };

constexpr Moment kinds_of_ten[] = {Moment::any_time,         Moment::any_time,       Moment::any_time,
                                   Moment::in_the_session,   Moment::in_the_session, Moment::in_the_session,
                                   Moment::in_the_session,   Moment::in_the_session, Moment::closing,
                                   Moment::making_the_folder};

/// Trials last longer than the tenth of a second after which rows are committed. With practice, breaks and
/// trials that come again: all of it is state to be rebuilt.
std::string eventful_protocol() {
    return with(small_protocol, "duration_s = 1", "duration_s = 20") + R"(
[[practice]]
task = "face"
object = "bust"
material = "matt"

[breaks]
every_trials = 3

[repeat]
gaze_lost = "end-of-block"
gaze_lost_limit = 0.02
most_attempts = 3
)";
}

constexpr const char* trials = "6";

class KilledSessions {
  public:
    explicit KilledSessions(std::uint64_t seed) : experiment_(eventful_protocol()), random_(seed, "kills") {
        // Fills the cache, and says how long a session takes.
        const auto begin = Clock_::now();
        REQUIRE(experiment_.run({"--observer", "X1", "--trials", trials}).exit_code == 0);
        REQUIRE(experiment_.run({"--observer", "X2", "--trials", trials}).exit_code == 0);
        duration_ = (Clock_::now() - begin) / 2;
    }

    /// Runs sessions, one after the other, each killed again and again and resumed until it is done.
    void kill(int times) {
        for (int session = 1; kills_ < times; ++session)
            run_to_its_end("P" + std::to_string(session), times);
        WARN(kills_ << " kills, " << sessions_ << " sessions: " << before_publishing_ << " before the folder "
                    << "had its name, " << in_a_trial_ << " with rows of a running trial, " << resumed_
                    << " resumptions, " << finished_later_ << " manifests finished afterwards");
    }

  private:
    using Completed = std::map<std::int64_t, std::pair<std::size_t, std::size_t>>;

    void run_to_its_end(const std::string& observer, int times) {
        const fs::path session = experiment_.session(1, observer);
        Completed before;
        for (bool is_done = false; !is_done;) {
            const bool exists = fs::exists(session);
            std::vector<std::string> arguments =
                run_arguments(experiment_, observer, {"--virtual-time", "--trials", trials});
            if (exists)
                arguments.emplace_back("--resume");
            resumed_ += exists;
            if (kills_ < times && run_and_kill(experiment_, arguments, moment(session))) {
                ++kills_;
                before_publishing_ += !fs::exists(session);
            } else {
                const std::string said = text_of(experiment_.folder().path() / "said");
                INFO(said);
                if (fs::exists(session) && SessionRecord(session).is_complete())
                    is_done = true;
                else {
                    const ProgramRun run = experiment_.overt(arguments);
                    INFO(run.err);
                    REQUIRE(run.exit_code == 0);
                    is_done = true;
                }
            }
            if (fs::exists(session))
                check_nothing_is_lost(session, before);
        }
        {
            const SessionRecord record(session);
            CHECK(record.is_complete());
            CHECK(is_the_plan(record));
        }
        CHECK(fs::exists(session / "session.sqlite"));
        CHECK_FALSE(fs::exists(session / "session.sqlite-wal"));
        // Whatever it was killed in, it is whole in the end: once more, if only the manifest was missing.
        std::vector<std::string> again = run_arguments(experiment_, observer, {"--virtual-time", "--resume"});
        const ProgramRun finished = experiment_.overt(again);
        INFO(finished.out << finished.err);
        CHECK((finished.exit_code == 0 || finished.exit_code == 2));
        CHECK(read_manifest(session).is_closed);
        finished_later_ += finished.exit_code == 0;
        ++sessions_;
    }

    std::function<bool()> moment(const fs::path& session) {
        const auto kind = kinds_of_ten[random_.below(10)];
        const auto begin = Clock_::now();
        const auto after = [](Clock_::time_point time) { return [time] { return Clock_::now() >= time; }; };
        const double share = random_.uniform();
        if (kind == Moment::any_time || (kind == Moment::making_the_folder && fs::exists(session)))
            return after(begin + std::chrono::duration_cast<Clock_::duration>(duration_ * share));
        const auto later = std::chrono::duration_cast<Clock_::duration>(duration_ * share * 0.7);
        const auto soon = std::chrono::microseconds(static_cast<int>(20'000 * share * share));
        // From the moment on that something is seen, a little later.
        auto seen = std::make_shared<std::optional<Clock_::time_point>>();
        return [=, this] {
            if (!*seen && is_seen(kind, session))
                *seen = Clock_::now();
            return *seen && Clock_::now() >= **seen + (kind == Moment::in_the_session ? later : soon);
        };
    }
    bool is_seen(Moment kind, const fs::path& session) const {
        if (kind == Moment::in_the_session)
            return text_of(experiment_.folder().path() / "said").find("display box: ") != std::string::npos;
        return kind == Moment::making_the_folder ? is_in_the_making(session) : is_closing(session);
    }
    static bool is_in_the_making(const fs::path& session) {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(session.parent_path(), none))
            if (entry.path().filename().string().starts_with("." + session.filename().string()))
                return true;
        return false;
    }
    static bool is_closing(const fs::path& session) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        const std::vector<TrialRecord> attempts = attempts_so_far(session);
        return std::count_if(attempts.begin(), attempts.end(), [](const TrialRecord& attempt) {
                   return attempt.counts;
               }) >= std::stoi(trials) - 1;
    }

    /// What was completed before is there still, row by row, and no trial counts twice.
    void check_nothing_is_lost(const fs::path& session, Completed& before) {
        const SessionRecord record(session);
        CHECK(record.damages() == std::vector<std::string>{});
        Completed now;
        for (const TrialRecord& attempt : record.trials()) {
            in_a_trial_ += attempt.status == TrialRecord::Status::open;
            if (attempt.counts)
                now[attempt.id] = {record.samples(attempt).size(), record.flips(attempt).size()};
        }
        for (const auto& [id, rows] : before) {
            REQUIRE(now.contains(id));
            CHECK(now[id] == rows);
        }
        for (const auto& [trial, times] : counted(record))
            CHECK(times == 1);
        const ProgramRun verified = experiment_.overt({"verify", session.string()});
        INFO(verified.out << verified.err);
        CHECK(verified.exit_code == 0);
        before = now;
    }

    SmallExperiment experiment_;
    RandomStream random_;
    Clock_::duration duration_{};
    int kills_ = 0, sessions_ = 0, before_publishing_ = 0, in_a_trial_ = 0, resumed_ = 0, finished_later_ = 0;
};

} // namespace

TEST_CASE("a session killed at random instants goes on each time and ends as planned", "[session]") {
    KilledSessions(std::random_device{}()).kill(7);
}

TEST_CASE("a session killed at 200 random instants goes on each time and ends as planned", "[.long]") {
    KilledSessions(std::random_device{}()).kill(200);
}
