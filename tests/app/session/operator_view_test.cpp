/// Sessions with an operator's view beside them, and what it must not do to them.
#include <catch2/catch.hpp>

#include <sys/stat.h>

#include "devices/operator/operator_client.h"
#include "devices/operator/operator_server.h"
#include "devices/operator/operator_socket.h"
#include "tests/app/session/exported_tables.h"
#include "tests/app/session/interrupted_run.h"
#include "tests/support/hurried_observer.h"

using namespace overt;
using namespace overt::test;

namespace {

using namespace std::chrono_literals;

/// A session in virtual time that stands still as soon as it has its socket, until it is let go.
class WatchedRun {
  public:
    explicit WatchedRun(const SmallExperiment& experiment, std::vector<std::string> more = {"--virtual-time"})
        : socket(experiment.folder().path() / "view.sock"), said(experiment.folder().path() / "said"),
          program_(arguments(experiment, socket, std::move(more)),
                   {"OVERT_CACHE=" + experiment.cache().string()}, said) {
        while (!std::filesystem::exists(socket) && program_.is_running())
            std::this_thread::sleep_for(50us);
        program_.signal(SIGSTOP);
        REQUIRE(program_.is_running());
    }
    void go_on() { program_.signal(SIGCONT); }
    int wait() { return program_.wait(); }

    const std::filesystem::path socket, said;

  private:
    static std::vector<std::string> arguments(const SmallExperiment& experiment,
                                              const std::filesystem::path& socket,
                                              std::vector<std::string> more) {
        more.insert(more.end(), {"--operator-socket", socket.string()});
        return run_arguments(experiment, "P01", more);
    }
    RunningProgram program_;
};

/// `overt watch` beside it, connected: the system takes connections to a session that stands still.
class WatchBeside {
  public:
    explicit WatchBeside(const WatchedRun& run, const std::string& name = "watched")
        : said(run.socket.parent_path() / name),
          program({"watch", "--terminal", "--operator-socket", run.socket.string()}, {}, said) {
        // Its greeting waits for five seconds, which is time enough to reach it.
        std::this_thread::sleep_for(300ms);
        REQUIRE(program.is_running());
    }
    const std::filesystem::path said;
    RunningProgram program;
};

int connected_to(const std::filesystem::path& socket) { return connect_to(SocketAddress(socket)); }

} // namespace

TEST_CASE(
    "a session has the same record with a view, with none, with one that was killed and with one that stands",
    "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run().exit_code == 0);
    const Tables alone = exported(experiment, 1);
    int session = 1;
    const auto check_same = [&](WatchedRun& run) {
        CHECK(run.wait() == 0);
        CHECK(differing(alone, exported(experiment, ++session)) == std::vector<std::string>{});
        CHECK(!std::filesystem::exists(run.socket));
    };
    SECTION("a socket to which nobody connects, one that is read, one that is killed, one that stands") {
        {
            WatchedRun run(experiment);
            run.go_on();
            check_same(run);
        }
        {
            WatchedRun run(experiment);
            WatchBeside watch(run);
            run.go_on();
            check_same(run);
            CHECK(watch.program.wait() == 0);
            const std::string said = text_of(watch.said);
            CHECK(said.find("the session is over: 10 of 10 done") != std::string::npos);
        }
        {
            WatchedRun run(experiment);
            WatchBeside watch(run);
            run.go_on();
            watch.program.signal(SIGKILL);
            check_same(run);
        }
        {
            WatchedRun run(experiment);
            WatchBeside watch(run);
            watch.program.signal(SIGSTOP);
            run.go_on();
            check_same(run);
        }
    }
    SECTION("one that sends garbage is cut off with a message, and one beside it goes on") {
        WatchedRun run(experiment);
        WatchBeside watch(run);
        const int garbage = connected_to(run.socket), endless = connected_to(run.socket);
        REQUIRE(garbage >= 0);
        REQUIRE(endless >= 0);
        const std::string request = "GET / HTTP/1.1\r\n\r\n", line(100'000, '\xff');
        CHECK(::send(garbage, request.data(), request.size(), MSG_NOSIGNAL) > 0);
        CHECK(::send(endless, line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT) > 0);
        run.go_on();
        check_same(run);
        INFO(text_of(watch.said));
        CHECK(watch.program.wait() == 0);
        const std::string said = text_of(run.said);
        CHECK(said.find(
                  "sent \"GET / HTTP/1.1 \", which is no command: it was cut off, and the session goes on") !=
              std::string::npos);
        CHECK(said.find("sent a line without an end: it was cut off") != std::string::npos);
        ::close(garbage);
        ::close(endless);
    }
}

TEST_CASE("commands from the view do what the operator's keys do, and stand in the record",
          "[session][waits]") {
    const SmallExperiment experiment;
    // In real time, so that a command meets the trial that it is for.
    std::vector<std::string> options = hurried(3, {.task_screens = false});
    options.insert(options.end(), {"--trials", "3"});
    WatchedRun run(experiment, options);
    run.go_on();
    OperatorClient client(run.socket);
    struct stat there {};
    CHECK(::stat(run.socket.c_str(), &there) == 0);
    CHECK((there.st_mode & 0777) == 0600);
    CHECK(client.facts().observer == "P01");
    bool is_rejected = false, is_skipped = false, is_checked = false, is_refused = false;
    std::string replies;
    std::deque<ViewedEvent> events;
    const auto send = [&](std::string_view words) { CHECK(client.send(operator_command(words).value())); };
    send("yes"); // nothing is asked
    send("note the observer wears glasses");
    while (client.read(20ms)) {
        const SessionView& view = client.view();
        if (view.phase == "stimulus" && view.is_lit() && !is_rejected) {
            send("reject");
            is_rejected = true;
        } else if (is_rejected && view.phase == "task screen" && view.failed == 1 && !is_checked) {
            send("drift check");
            is_checked = true;
        } else if (is_checked && view.phase == "stimulus" && view.done == 1 && !is_skipped) {
            send("skip 1");
            is_skipped = true;
        }
        for (ViewedEvent& event : client.take_events()) {
            is_refused = is_refused || event.detail.find("the session asks nothing") != std::string::npos;
            events.push_back(std::move(event));
        }
    }
    CHECK(run.wait() == 0);
    CHECK(client.view().is_over);
    CHECK((is_rejected && is_checked && is_skipped && is_refused));
    const std::string recorded = exported(experiment, 1).at("events.tsv");
    for (const char* const words :
         {"operator's note\tthe observer wears glasses", "operator's view\treject",
          "operator pressed\treject", "operator\trejects the trial", "operator's view\tskip 1",
          "operator\tskips the trial: ", "operator pressed\tdrift check", "drift checked\t"}) {
        INFO(words << "\n" << recorded);
        CHECK(recorded.find(words) != std::string::npos);
    }
    CHECK(recorded.find("operator's view\tyes") == std::string::npos);
}

TEST_CASE("overt watch says what it needs where there is nothing to watch", "[session]") {
    const SmallExperiment experiment;
    const auto check_refused = [&](const std::vector<std::string>& arguments, const std::string& words) {
        const ProgramRun run = experiment.overt(arguments);
        CHECK(run.exit_code == 2);
        INFO(run.err);
        CHECK(run.err.find(words) != std::string::npos);
    };
    const std::string folder = experiment.folder().path().string();
    check_refused({"watch", "--terminal", "--sessions", folder}, "no session that can be watched runs there");
    check_refused({"watch", "--terminal", "--operator-socket", folder + "/none.sock"},
                  "no session serves this socket");
    check_refused({"watch", "--terminal", folder + "/none"}, "is no session's folder");
    check_refused({"watch", "--once", "--send", "stop", folder}, "is no command");
    const ProgramRun run = experiment.run({"--operator-socket", folder + "/none/view.sock"});
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("name a folder that exists") != std::string::npos);
    CHECK(!std::filesystem::exists(experiment.sessions()));
}
